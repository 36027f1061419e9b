"""Scenarios of a network, its exports, edits and commands, as texts below `scenarios/`: `pytest -k WORDS` runs some.

A text begins with what its scenarios share, each `-- NAME`; then each begins with `== TITLE`. What a line may say:

    $ COMMAND => CODE        a command and its exit code, 0 if none is there; `$=` if it changes no file
      TEXT                   which it prints; `! TEXT`, which it does not
    begin NAME               what is shared under this name
    source OLD => NEW        an export: another text in the source, wherever it is
    configure LINE           one more line of the robot's table; `config OLD => NEW`, another text in the configuration
    edit FILE OLD => NEW     an edit by hand; `write FILE TEXT`, `delete FILE`, `move` or `copy FILE FILE`
    keep NAME FILE           remembers a text; `same NAME FILE`: it is that one now
    has FILE TEXT            also `lacks FILE TEXT`, `exists FILE`, `gone FILE`, `order FILE NAME…` (exactly these)
    run FILE REASON…         a build, and what happens to all files that do not just stay; `run dry` writes nothing
    aside TEXT               a text that was replaced has it
    conflicts FILE…          the conflicts that a dry build finds

Files are those of the package, or begin with `/`: then they are of the project. `@FILE` is such a path in a command and
in what it prints, `\\n` a line end. `A || B` in a title and in lines makes two scenarios of one.
"""

from __future__ import annotations

import contextlib
import re
import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, ClassVar

import pytest
from support.commands import Execute, Printed
from support.files import unchanged
from support.networks import LADDER, conflicts, edit, kinds, run

FOLDER = Path(__file__).with_name("scenarios")


def scenarios() -> Iterator[Any]:
    """All of all texts; each has the lines that its text shares, by name."""
    for file in sorted(FOLDER.glob("*.txt")):
        first, *found = re.split(r"(?m)^== ", file.read_text("utf-8"))
        shared = {name: lines for name, _, lines in (part.partition("\n") for part in re.split(r"(?m)^-- ", first)[1:])}
        for title, _, lines in (scenario.partition("\n") for scenario in found):
            for number in range(1 + title.count(" || ")):
                name, text = (re.sub(r"\S+(?: \|\| \S+)+", lambda m, n=number: m[0].split(" || ")[n], t)
                              for t in (title, lines))  # fmt: skip
                yield pytest.param(text, shared, id=f"{file.stem}: {name}")


def path_of(file: str) -> Path:
    """A file of the package, or of the project."""
    return Path(file[1:]) if file.startswith("/") else Path(LADDER, file)


class Scenario:
    """One that is played, line by line."""

    def __init__(self, execute: Execute, shared: Mapping[str, str]) -> None:
        self._execute, self._shared = execute, shared
        self._kept = dict[str, str]()
        self._printed = Printed(0, "", "")

    def play(self, lines: str) -> None:
        """Do and compare what the lines say."""
        for line in filter(None, lines.splitlines()):
            verb, _, rest = line.replace("\\n", "\n").partition(" ")
            assert verb in self.VERBS, line
            try:
                self.VERBS[verb](self, rest)
            except AssertionError as error:
                raise AssertionError(f"{line}\n{error}\n{self._printed.out}{self._printed.err}") from error

    def command(self, rest: str, *, changes: bool = True) -> None:
        words, _, code = rest.partition(" => ")
        quiet = contextlib.nullcontext() if changes else unchanged(Path.cwd(), but=".urdfsync/lock")
        with quiet:
            self._printed = self._execute(*re.sub(r"(?<!\S)@", f"{LADDER}/", words).split(), code=int(code or 0))

    def says(self, rest: str) -> None:
        text = rest.strip().removeprefix("! ").replace("@", f"{LADDER}/")
        assert (" ".join(text.split()) in self._printed.words) is not rest.strip().startswith("! ")

    def begin(self, name: str) -> None:
        self.play(self._shared[name])

    def source(self, rest: str) -> None:
        edit("ladder.json", *rest.split(" => "))

    def configure(self, line: str) -> None:
        with Path("urdfsync.toml").open("a") as file:
            file.write(f"{line}\n")

    def config(self, rest: str) -> None:
        edit("urdfsync.toml", *rest.split(" => "))

    def edit(self, rest: str) -> None:
        file, change = rest.split(" ", 1)
        edit(path_of(file), *change.split(" => "))

    def write(self, rest: str) -> None:
        file, text = rest.split(" ", 1)
        path_of(file).parent.mkdir(parents=True, exist_ok=True)
        path_of(file).write_text(text)

    def delete(self, file: str) -> None:
        path = path_of(file)
        shutil.rmtree(path) if path.is_dir() else path.unlink()

    def move(self, rest: str) -> None:
        old, new = map(path_of, rest.split())
        new.parent.mkdir(parents=True, exist_ok=True)
        old.rename(new)

    def copy(self, rest: str) -> None:
        shutil.copy(*map(path_of, rest.split()))

    def keep(self, rest: str) -> None:
        name, file = rest.split()
        self._kept[name] = path_of(file).read_text()

    def same(self, rest: str) -> None:
        name, file = rest.split()
        assert path_of(file).read_text() == self._kept[name]

    def has(self, rest: str, *, there: bool = True) -> None:
        file, text = rest.split(" ", 1)
        assert (text in path_of(file).read_text()) is there, path_of(file).read_text()

    def lacks(self, rest: str) -> None:
        self.has(rest, there=False)

    def aside(self, text: str) -> None:
        assert any(text in file.read_text() for file in Path(".urdfsync/aside").rglob("*.mo"))

    def exists(self, file: str) -> None:
        assert path_of(file).exists()

    def gone(self, file: str) -> None:
        assert not path_of(file).exists()

    def order(self, rest: str) -> None:
        file, *names = rest.split()
        assert sorted(path_of(file).read_text().split()) == sorted(names)

    def run(self, rest: str) -> None:
        words = rest.split()
        dry = words[:1] == ["dry"]
        words = words[dry:]
        found = {str(path): str(reason) for path, reason in kinds(run(dry=dry)).items()}
        expected = dict(zip(words[::2], words[1::2], strict=True))
        assert found == {path_of(path).as_posix(): reason for path, reason in expected.items()}

    def conflicts(self, rest: str) -> None:
        assert conflicts(dry=True) == [path_of(file).as_posix() for file in rest.split()]

    VERBS: ClassVar[Mapping[str, Any]] = {
        "$": command,
        "$=": lambda self, rest: self.command(rest, changes=False),
        "": says,
        **{each.__name__: each for each in (begin, source, configure, config, edit, write, delete, move, copy)},
        **{each.__name__: each for each in (keep, same, has, lacks, aside, exists, gone, order, run, conflicts)},
    }


@pytest.mark.parametrize(("lines", "shared"), list(scenarios()))
def test_scenarios(project: Path, execute: Execute, lines: str, shared: Mapping[str, str]) -> None:
    Scenario(execute, shared).play(lines)
