"""CLIPS on the same rulebook: what it decides, and how long a decision takes.

Runs in CLIPS's own environment and imports nothing of gaitwright. One argument: a JSON file with
`constructs`, `loops` (CLIPS functions that decide everything) and `situations` (a symbol per tree).
Spoken over stdin and stdout, one JSON object a line: a greeting; for "decide" the place of the rule of every
situation; for "run K" the µs per decision over all situations, the best of K passes: called from Python, and
within CLIPS.
"""

import gc
import json
import sys
import time
from pathlib import Path

import clips  # pyright: ignore[reportMissingImports]


def main(path: Path) -> None:
    """Builds the rulebook, then answers until the end of stdin."""
    problem = json.loads(path.read_text(encoding="utf-8"))
    environment = clips.Environment()
    for construct in (*problem["constructs"], *problem["loops"]):
        environment.build(construct)
    decide = environment.find_function("decide")
    situations = [[clips.Symbol(word) for word in words] for words in problem["situations"]]
    loops = [f"(all-{k})" for k in range(len(problem["loops"]))]
    say({"version": clips.__version__})
    for line in sys.stdin:
        command, *words = line.split() or [""]
        if command == "decide":
            say({"decisions": [int(decide(*situation)) for situation in situations]})
        elif command == "run":
            called = best(lambda: [decide(*situation) for situation in situations], int(words[0]))
            inside = best(lambda: [environment.eval(loop) for loop in loops], int(words[0]))
            say({"called_us": called / len(situations), "inside_us": inside / len(situations)})


def best(work, passes: int) -> float:
    """How long it takes at best, in µs."""
    took = []
    gc.disable()
    for _ in range(passes):
        began = time.perf_counter_ns()
        work()
        took.append((time.perf_counter_ns() - began) / 1e3)
    gc.enable()
    return min(took)


def say(message: dict) -> None:
    print(json.dumps(message), flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
