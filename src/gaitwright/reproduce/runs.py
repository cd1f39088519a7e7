"""One run: table after table, figure after figure, each shown and written as soon as it is done."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

from rich.console import Console

from gaitwright.errors import WrongUse
from gaitwright.files import whole
from gaitwright.numerics.compiled import is_warm
from gaitwright.reproduce.claim import Reproduction, Say
from gaitwright.reproduce.report import markdown, show, to_json, write_text
from gaitwright.screen import paragraph, width_of
from gaitwright.screen import show as show_lines


def reproduce_all(names: list[str], out: str, json_path: str | None) -> int:
    """Reproduces, prints and writes; returns the exit code: 0 where every claim agrees that can, else 1."""
    folder = Path(out)
    if folder.exists() and not folder.is_dir():
        raise WrongUse(f"--out {out} is a file; name a folder")
    to_stderr = json_path == "-"
    results = []
    for name in names:
        module = import_module(f"gaitwright.reproduce.{name.replace('-', '_').replace('.', '_')}")
        with progress(name) as say:
            if not is_warm():
                say("loading kernels (a first run compiles them, up to two minutes)")
            result = module.reproduce(say)
            say("writing")
            files = write(result, folder)
        results.append(result)
        show(result, to_stderr)
        file = sys.stderr if to_stderr else sys.stdout
        show_lines(paragraph(f"written: {', '.join(files)}", width_of(file)), file)
    if to_stderr:
        print(to_json(results))
    elif json_path is not None:
        write_text(Path(json_path), to_json(results) + "\n")
    return 0 if all(result.agrees for result in results) else 1


def write(result: Reproduction, folder: Path) -> list[str]:
    """Writes a reproduction and its pictures into a folder, over those of an earlier run; their paths."""
    drawn = []
    if result.pictures and not find_spec("matplotlib"):
        print("the pictures are left out: they need `pip install 'gaitwright[plot]'`", file=sys.stderr)
    else:
        for picture in result.pictures:
            with whole(folder / picture.name) as draft:
                picture.draw(draft)
            drawn.append(picture.name)
    page = f"{result.name}.md"
    write_text(folder / page, markdown(result, drawn))
    return [str(folder / name) for name in (page, *drawn)]


@contextmanager
def progress(name: str) -> Iterator[Say]:
    """Says what is being done on the standard error: a moving line on a terminal, else line by line."""
    if sys.stderr.isatty():
        with Console(stderr=True, highlight=False).status(name) as status:
            yield lambda text: status.update(f"{name}: {text}")
    else:
        yield lambda text: print(f"reproduce: {name}: {text}", file=sys.stderr, flush=True)
