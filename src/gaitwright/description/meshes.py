"""The name of a mesh in a robot's file → the file itself, if it lies in a folder that may be read.

Those are the robot file's own folder with all below it, its package (the folder with a `package.xml`, or the
one around a folder called `urdf` and the like), and the packages that the user names.
"""

import os
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from itertools import islice
from pathlib import Path

from gaitwright.description.vertices import READ_HERE, vertices_of

MESH_SUFFIXES = (".obj", ".stl", ".msh")
"""What MuJoCo reads."""
LONGEST_NAME = 1000
"""A longer name of a mesh is none [letters]."""
INNER_FOLDERS = {"urdf", "xml", "mjcf", "robot", "robots", "model", "models", "description", "xacro"}
"""Folders in which a package keeps its robot files, beside its meshes."""
UPWARDS = 3
"""A `package.xml` is looked for in so many folders above the file's own."""
MOST_ENTRIES = 10_000
"""Larger folders are not searched for a name in other letters."""
LFS = b"version https://git-lfs"
"""How the placeholder of a large file begins that was not downloaded."""
STL_HEAD, STL_FACE = 84, 50
"""Bytes of the head and of each face of a binary STL file."""


def package_folder(folder: Path) -> Path:
    """The folder of the package that a robot file's folder belongs to; itself where there is none."""
    for above in (folder, *folder.parents[:UPWARDS]):
        if (above / "package.xml").is_file():
            return above
    return folder.parent if folder.name.lower() in INNER_FOLDERS else folder


@dataclass(frozen=True)
class Meshes:
    """The folders in which meshes may be, and what was looked for in vain."""

    folder: Path
    """Of the robot's file."""
    packages: Mapping[str, Path] = field(default_factory=dict)
    """Folders by the name of the package, as the user gave them."""
    lost: dict[str, str] = field(default_factory=dict)
    """By link: a mesh of its that is not there."""
    known: dict[tuple[str, str], Path | None] = field(default_factory=dict)
    """What was found for a name and a folder, so that nothing is looked for twice."""

    @cached_property
    def allowed(self) -> list[Path]:
        """Folders that may be read, with all below them."""
        own = self.folder.resolve()
        return [own, package_folder(own), *(folder.resolve() for folder in self.packages.values())]

    def find(self, name: str, meshdir: str = "") -> Path | None:
        """The file of a mesh called `name`, from the folder `meshdir` where it is not absolute."""
        if (name, meshdir) not in self.known:
            self.known[name, meshdir] = self.searched(name, meshdir)
        return self.known[name, meshdir]

    def searched(self, name: str, meshdir: str) -> Path | None:
        """As `find`, by looking at every place."""
        if not name or len(name) > LONGEST_NAME or "\0" in name:
            return None
        places = list(self.places(name.replace("\\", "/"), meshdir))
        for usable in (self.usable, self.read_here):
            for exact in (True, False):
                for place in places:
                    found = usable(place, exact)
                    if found is not None:
                        return found
        return None

    def places(self, name: str, meshdir: str) -> Iterator[Path]:
        """Where a mesh may be, the likeliest place first."""
        scheme, _, rest = name.rpartition("://")
        package, _, within = rest.lstrip("/").partition("/")
        if scheme in ("package", "model"):
            if package in self.packages:
                yield self.packages[package] / within
        else:
            yield self.folder / meshdir / rest
            yield self.folder / rest
        words = [word for word in rest.split("/") if word not in ("", ".", "..")]
        for start in range(len(words)):
            tail = "/".join(words[start:])
            for root in self.allowed:
                yield root / tail
                yield root / "meshes" / tail

    def usable(self, place: Path, exact: bool) -> Path | None:
        """A mesh that MuJoCo reads at that place or, in another form, beside it; `exact`: same letters."""
        for suffix in dict.fromkeys((place.suffix, *MESH_SUFFIXES)):
            path = Path(os.path.normpath(place.with_suffix(suffix)))
            path = path if exact else self.in_other_letters(path)
            if path is not None and path.suffix.lower() in MESH_SUFFIXES and self.may_read(path):
                return path.resolve() if is_read_by_mujoco(path) else None
        return None

    def read_here(self, place: Path, exact: bool) -> Path | None:
        """A mesh at that place that we read and MuJoCo does not."""
        path = Path(os.path.normpath(place))
        path = path if exact else self.in_other_letters(path)
        if path is None or path.suffix.lower() not in READ_HERE or not self.may_read(path):
            return None
        return path.resolve() if vertices_of(path) is not None else None

    def may_read(self, path: Path) -> bool:
        """Whether a path is a file inside the allowed folders, links followed."""
        try:
            real = path.resolve()
            return any(real.is_relative_to(root) for root in self.allowed) and real.is_file()
        except OSError:
            return False

    def in_other_letters(self, path: Path) -> Path | None:
        """The file whose path is this one but for capitals, below an allowed folder."""
        root = next((root for root in self.allowed if path.is_relative_to(root)), None)
        if root is None:
            return None
        here = root
        for word in path.relative_to(root).parts:
            here = here / word if (here / word).exists() else same_letters(here, word)
            if here is None:
                return None
        return here

    def why(self, name: str) -> str:
        """Why a mesh is missing, and what would help."""
        package = re.match(r"(?:package|model)://([^/]+)", name)
        known = package[1] if package else "NAME"
        found = "is not an OBJ, STL, COLLADA or MSH file in the folders that may be read"
        return f"mesh {name!r} {found}; --package {known}=FOLDER names one more"


def same_letters(folder: Path, word: str) -> Path | None:
    """What is called `word` in a folder, capitals aside."""
    name = names_in(folder).get(word.lower())
    return None if name is None else folder / name


@lru_cache(maxsize=1000)
def names_in(folder: Path) -> dict[str, str]:
    """Names in a folder by their small letters."""
    try:
        with os.scandir(folder) as entries:
            return {entry.name.lower(): entry.name for entry in islice(entries, MOST_ENTRIES)}
    except OSError:
        return {}


def is_read_by_mujoco(path: Path) -> bool:
    """Whether a file looks like one that MuJoCo reads: no placeholder, and STL in its binary form."""
    if path.suffix.lower() not in MESH_SUFFIXES:
        return False
    try:
        with path.open("rb") as file:
            head = file.read(STL_HEAD)
    except OSError:
        return False
    if head.startswith(LFS):
        return False
    if path.suffix.lower() != ".stl":
        return len(head) > 0
    faces = int.from_bytes(head[STL_HEAD - 4 :], "little")
    return len(head) == STL_HEAD and path.stat().st_size == STL_HEAD + STL_FACE * faces
