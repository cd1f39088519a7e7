"""Takes cases one after the other, in a process that may be killed: `python -m gaitwright.bench.fuzz.worker
KIND SEED FIRST BEYOND FOLDER`. A line of JSON tells of each; before the first one stands `ready`."""

import sys
from pathlib import Path

import msgspec

from gaitwright.bench.fuzz.case import prepared, run_case
from gaitwright.bench.fuzz.kinds import KINDS


def main(kind: str, seed: int, first: int, beyond: int, folder: Path) -> None:
    """Takes the cases from `first` on, up to `beyond`."""
    lines = sys.stdout
    sys.stdout = sys.stderr  # what a case prints is none of a line of ours
    KINDS[kind].originals()
    prepared(folder)
    print("ready", file=lines, flush=True)
    for number in range(first, beyond):
        outcome = run_case(kind, seed, number, folder)
        print(msgspec.json.encode(outcome).decode(), file=lines, flush=True)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4]), Path(sys.argv[5]))
