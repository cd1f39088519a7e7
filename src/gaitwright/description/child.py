"""Reads one robot's file under limits and prints its numbers as JSON, for `description/load.py`.

Run as `python -m gaitwright.description.child FILE [NAME=FOLDER …]`, with the packages whose meshes may be
read. Exit code 0: `{"robot": …, "notes": …}`; 3: the file is refused, `{"error": sentence}`.
"""

import os
import sys
from pathlib import Path

import msgspec

from gaitwright.description.reading import read_robot
from gaitwright.errors import BadFile
from gaitwright.model.robot import lists_of

CPU_SECONDS = 30
"""CPU time for one file [s]."""
MEMORY_BYTES = 4_000_000_000
"""Memory for one file, as addresses [bytes]."""


def main(path: Path, packages: dict[str, Path]) -> int:
    """Prints the robot in `path`, or why it is refused."""
    limit()
    try:
        robot, notes = read_robot(path, packages)
    except BadFile as error:
        sys.stdout.buffer.write(msgspec.json.encode({"error": str(error)}))
        return BadFile.exit_code
    sys.stdout.buffer.write(msgspec.json.encode({"robot": lists_of(robot), "notes": notes}))
    return 0


def limit() -> None:
    """Limits CPU time and memory of this process, and forbids it to write files. POSIX only."""
    if os.name != "posix":
        return
    import resource

    seconds = int(sum(os.times()[:2])) + CPU_SECONDS
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 2))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
    resource.setrlimit(resource.RLIMIT_FSIZE, (0, 0))


if __name__ == "__main__":
    named = (word.split("=", 1) for word in sys.argv[2:])
    sys.exit(main(Path(sys.argv[1]), {name: Path(folder) for name, folder in named}))
