"""The proof of a redesign: the same commands move the same robots bit for bit, before and after.

    python tests/same_motion.py REVISION          # REVISION beside the files as they are now
    python tests/same_motion.py --now             # only now: prints each command's state hash
    python tests/same_motion.py --write FILE      # only now: keeps them in a file
    python tests/same_motion.py --against FILE    # those of such a file beside now

`--only WORDS` goes with each: only the commands in which these words stand, `--only rough` for instance.
Thirty commands over skills, robots, plants, drivers and terrains run in two processes, one on a git worktree
of the revision and one on this checkout, both with the packages installed here. A line each: the command, the
two hashes, whether they agree. Exit code 1 where any differs. Hashes of two machines need not agree; those of
two states of the code on one machine must, where a change is meant to move nothing.
"""

import argparse
import contextlib
import io
import json
import os
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).parent.parent
SKILL = "skill --seconds 4 "
COMMANDS = (
    SKILL + "--skill stand",
    SKILL + "--skill walk --lateral 0.1 --turn 0.3 --seed 3",
    SKILL + "--skill walk --scene stairs:0.1 --seconds 8",
    SKILL + "--skill walk-backward --scene cross-slope:10",
    SKILL + "--skill walk-sideways --distribution lp",
    SKILL + "--skill climb --scene stairs:0.1 --seed 2 --seconds 8",
    SKILL + "--skill descend --scene slope:-15",
    SKILL + "--skill trot --push 0.5 90",
    SKILL + "--skill trot --scene rough:0.05 --seed 5",
    SKILL + "--skill trot --scene slope:15 --turn 0.2",
    SKILL + "--skill trot --scene slippery:0.3 --driver kinematic",
    SKILL + "--skill trot --driver programmed",
    SKILL + "--skill trot --cycle trot --distribution lp",
    SKILL + "--skill turn-in-place",
    SKILL + "--skill turn-left",
    SKILL + "--skill run",
    SKILL + "--skill pace --scene ramp:15",
    SKILL + "--skill rack",
    SKILL + "--skill pronk",
    SKILL + "--skill bound",
    SKILL + "--skill gallop --seed 1",
    SKILL + "--skill rotary-gallop",
    SKILL + "--robot hexapod --skill tripod",
    SKILL + "--robot hexapod --skill ripple --scene rough:0.01",
    SKILL + "--robot thesis --skill walk --plant armstrong --seconds 1",
    SKILL + "--robot thesis --skill walk --scene stairs",
    "skill --robot thesis --skill climb --scene stairway --plant kinematic --driver kinematic",
    SKILL + "--skill trot --plant kinematic --driver programmed",
    "mission --goal 6 0 --seed 1",
    "mission --scene rough:0.03 --waypoints 2,1 4,-1 --seed 4 --driver kinematic --seconds 12",
)


def chosen(words: str) -> tuple[str, ...]:
    """The commands in which these words stand."""
    commands = tuple(command for command in COMMANDS if words in command)
    if not commands:
        raise SystemExit(f"no command has {words!r} in it; there is:\n" + "\n".join(COMMANDS))
    return commands


def hashes(commands: Sequence[str]) -> dict[str, str]:
    """Command → its state hash, or what it ended with where it made none."""
    from gaitwright.cli import main

    found = {}
    for command in commands:
        out, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
            code = main([*shlex.split(command), "--json", "-"])
        try:
            found[command] = json.loads(out.getvalue())["state_hash"]
        except ValueError:
            found[command] = f"exit {code}: {errors.getvalue().strip().splitlines()[-1]}"
        print(f"{found[command][:16]}  {command}", file=sys.stderr, flush=True)
    return found


def started(root: Path, answer: Path, words: str) -> subprocess.Popen:
    """A process that writes the hashes of the code under `root` to `answer`."""
    script = Path(__file__).resolve()
    environment = {**os.environ, "PYTHONPATH": str(root / "src")}
    command = [sys.executable, str(script), f"--only={words}", "--write", str(answer)]
    return subprocess.Popen(command, env=environment, cwd=root)


def compare(revision: str, words: str) -> int:
    """Runs both sides at once and prints both columns; the number of commands that differ."""
    with tempfile.TemporaryDirectory() as folder:
        before, answers = Path(folder) / "before", [Path(folder) / f"{side}.json" for side in "bn"]
        subprocess.run(
            ["git", "worktree", "add", "--quiet", "--detach", before, revision], cwd=ROOT, check=True
        )
        try:
            places = zip((before, ROOT), answers, strict=True)
            sides = [started(root, answer, words) for root, answer in places]
            if any([side.wait() for side in sides]):
                raise SystemExit("one side did not come to its end")
            was, now = (json.loads(answer.read_text(encoding="utf-8")) for answer in answers)
        finally:
            subprocess.run(["git", "worktree", "remove", "--force", before], cwd=ROOT, check=True)
    return show(was, now)


def show(was: dict[str, str], now: dict[str, str]) -> int:
    """Prints both columns for every command of now; how many differ, or were not there before."""
    differ = 0
    for command, found in now.items():
        before = was.get(command, "not there")
        differ += before != found
        told = "same" if before == found else "DIFFERENT"
        print(f"{before[:16]:16}  {found[:16]:16}  {told:9}  {command}")
    print(f"{len(now) - differ} of {len(now)} the same")
    return differ


def main(words: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("revision", nargs="?", default="HEAD", help="what to compare with (HEAD)")
    parser.add_argument("--now", action="store_true", help="only the files as they are now")
    parser.add_argument("--write", metavar="FILE", help="only the files as they are now, kept in a file")
    parser.add_argument("--against", metavar="FILE", help="what --write kept, in place of a revision")
    parser.add_argument("--only", metavar="WORDS", default="", help="only commands with these words")
    args = parser.parse_args(words)
    commands = chosen(args.only)
    if not (args.now or args.write or args.against):
        return 1 if compare(args.revision, args.only) else 0
    now = hashes(commands)
    if args.now:
        print("\n".join(f"{told}  {command}" for command, told in now.items()))
    if args.write:
        Path(args.write).write_text(json.dumps(now), encoding="utf-8")
    if args.against:
        return 1 if show(json.loads(Path(args.against).read_text(encoding="utf-8")), now) else 0
    return 0


if __name__ == "__main__":
    sys.exit(main())
