"""Scenarios of a robot, its exports, edits and commands, as texts below `scenarios/`: `pytest -k WORDS` runs some.

A text begins with what its scenarios share, each `-- NAME`; then each begins with `== TITLE`. What a line may say:

    $ COMMAND => CODE        a command and its exit code, 0 if none is there; `$=` if it changes no file
      TEXT                   which it prints; `! TEXT`, which it does not
    again                    the last command once more, and what the lines since then compare holds again
    begin NAME, NAME…        what is shared under these names
    source OLD => NEW        an export: another text in the source, wherever it is
    set NAME VALUE           an export of the network: another value; also `add NAME`, `drop NAME`, `rename OLD NEW`
    project NAME             another project, whose robot has this name: a URDF, of which the next two write an export
    arm LINK MASS, …         links one after the other, from the base on; `legs LINK MASS, …`, all at the base
    configure LINE           one more line of the robot's table; `config OLD => NEW`, another text in the configuration
    edit FILE OLD => NEW     an edit by hand; `write FILE TEXT`, `delete FILE`, `move` or `copy FILE FILE`
    insert FILE TEXT         one more line before the equations; `note FILE TEXT`, a remark at the end;
                           `unstamp FILE` removes its stamp
    template TEXT            templates of the user's own, with this line in the model of each element
    editor FILE              the user's editor: it saves the text of this file, and what it was shown in `/shown`
    commit                   all files, in a new repository if there is none
    branch NAME START        a new branch, from `main` if no start is there
    git COMMAND => CODE      any other command of git
    clone                    commits and clones: from here on, all is done here and in the clone, with the same results
    keep NAME FILE           remembers a text without its stamp; `same NAME FILE`: it is that one now
    has FILE TEXT            also `lacks FILE TEXT`, `exists FILE`, `gone FILE`, `order FILE NAME…` (exactly these)
    run FILE REASON…         a build, and what happens to all files that do not just stay; `run dry` writes nothing
    only FILE TEXT           of all models, this one alone has the text
    fresh                    all models are as in a first build from the source, but for remarks
    aside TEXT               a text that was replaced has it
    conflicts FILE…          the conflicts that a dry build finds
    posix REASON             what follows needs what Windows lacks

Files are those of the package, or begin with `/`: then they are of the project. `@FILE` is such a path in a command and
in what it prints, `\\n` a line end. `A || B` in a title and in lines makes two scenarios of one, of which the first is
quick. A link `2` is the link `link_2` at the joint `joint_2`, whose place follows from the mass; `JOINT LINK MASS`
names both. `MASS/SIZE` or `MASS/NAME:SIZE` gives it boxes, to be seen and to collide; then its joint is where the joint
before is.
"""

from __future__ import annotations

import contextlib
import os
import re
import shlex
import shutil
import subprocess
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, ClassVar

import pytest
from support import branches, networks
from support.commands import Editor, Execute, Printed
from support.files import delete, fresh_models, models, unchanged
from support.git import Repository
from support.networks import conflicts, edit, kinds, run
from support.replay import contents
from support.urdfs import robot_of

from urdfsync.modelica.stamp import split

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
                marks = [pytest.mark.slow] if number else []
                yield pytest.param(text, shared, id=f"{file.stem}: {name}", marks=marks)


class Scenario:
    """One that is played, line by line."""

    def __init__(
        self, execute: Execute, editor: Editor, monkeypatch: pytest.MonkeyPatch, shared: Mapping[str, str]
    ) -> None:
        self._execute, self._editor, self._monkeypatch, self._shared = execute, editor, monkeypatch, shared
        self._source, self._package = "ladder.json", "modelica/Ladder"
        self._folders = [Path.cwd()]
        self._kept = dict[str, str]()
        self._printed = Printed(0, "", "")
        self._last = list[tuple[str, str]]()

    def play(self, lines: str) -> None:
        """Do and compare what the lines say."""
        for line in filter(None, lines.splitlines()):
            verb, _, rest = line.replace("\\n", "\n").partition(" ")
            assert verb in self.VERBS, line
            try:
                self.everywhere(verb, rest)
            except AssertionError as error:
                raise AssertionError(f"{line}\n{error}\n{self._printed.out}{self._printed.err}") from None

    def everywhere(self, verb: str, rest: str) -> None:
        """Do what a line says in each clone; a command prints and writes the same in all."""
        folders = self._folders[: 1 if verb in ("again", "begin", "clone") else None]
        results = []
        if verb.startswith("$"):
            self._last = []
        if verb.startswith("$") or verb in ("", "has", "lacks", "only", "same", "exists", "gone", "order"):
            self._last.append((verb, rest))
        for folder in folders:
            with contextlib.chdir(folder):
                self.VERBS[verb](self, rest)
                if verb.startswith("$") and len(folders) > 1:
                    results.append((self._printed.out, contents(Path(self._package))))
        assert all(result == results[0] for result in results)

    def path(self, file: str) -> Path:
        """A file of the package, or of the project."""
        path = Path(file[1:]) if file.startswith("/") else Path(self._package, file)
        return next(iter(sorted(path.parent.glob(path.name))), path) if "*" in file else path

    def command(self, rest: str, *, changes: bool = True) -> None:
        words, _, code = rest.partition(" => ")
        quiet = contextlib.nullcontext() if changes else unchanged(Path.cwd(), but=".urdfsync/lock")
        with quiet:
            named = re.sub(r"(?<!\S)@", f"{self._package}/", words)
            self._printed = self._execute(*named.split(), code=int(code or 0))

    def says(self, rest: str) -> None:
        text = rest.strip().removeprefix("! ").replace("@", f"{self._package}/")
        is_printed = " ".join(text.split()) in self._printed.words
        assert is_printed is not rest.strip().startswith("! "), "printed:" if is_printed else "not printed, but:"

    def again(self, _: str) -> None:
        for line in tuple(self._last):
            self.everywhere(*line)

    def begin(self, names: str) -> None:
        for name in names.split(", "):
            self.play(self._shared[name])

    def source(self, rest: str) -> None:
        edit(self._source, *rest.split(" => "))

    def project(self, name: str) -> None:
        self._source, self._package = f"{name}.urdf", f"modelica/{name.capitalize()}"
        table = f'[robots.{name}]\nsource = "{self._source}"\npackage = "{name.capitalize()}"\n'
        Path("urdfsync.toml").write_text(table)

    def arm(self, links: str) -> None:
        Path(self._source).write_text(robot_of(links))

    def legs(self, links: str) -> None:
        Path(self._source).write_text(robot_of(links, are_legs=True))

    def configure(self, line: str) -> None:
        with Path("urdfsync.toml").open("a", newline="\n") as file:
            file.write(f"{line}\n")

    def config(self, rest: str) -> None:
        edit("urdfsync.toml", *rest.split(" => "))

    def edit(self, rest: str) -> None:
        file, change = rest.split(" ", 1)
        edit(self.path(file), *change.split(" => "))

    def insert(self, rest: str) -> None:
        file, text = rest.split(" ", 1)
        edit(self.path(file), "\nequation\n", f"\n  {text}\n\nequation\n")

    def note(self, rest: str) -> None:
        file, text = rest.split(" ", 1)
        branches.note(str(self.path(file)), text)

    def unstamp(self, file: str) -> None:
        self.path(file).write_text(split(self.path(file).read_text())[0])

    def template(self, text: str) -> None:
        networks.own_model(text)

    def editor(self, file: str) -> None:
        shown, text = Path("shown").absolute(), self.path(file).read_text()
        self._editor(f"Path({str(shown)!r}).write_text(file.read_text()); file.write_text({text!r})")

    def commit(self, _: str) -> None:
        if shutil.which("git") is None:
            pytest.skip("git is not installed")
        Repository(Path.cwd(), self._monkeypatch).commit()

    def branch(self, rest: str) -> None:
        name, _, start = rest.partition(" ")
        self.git(f"checkout -q -b {name} {start or 'main'}")

    def git(self, rest: str) -> None:
        words, _, code = rest.partition(" => ")
        done = subprocess.run(["git", *shlex.split(words)], capture_output=True, text=True)
        self._printed = Printed(done.returncode, done.stdout, done.stderr)
        assert done.returncode == int(code or 0)

    def clone(self, _: str) -> None:
        self.commit("")
        self.git("clone -q . ../clone")
        self._folders.append(Path("../clone").resolve())

    def write(self, rest: str) -> None:
        file, text = rest.split(" ", 1)
        self.path(file).parent.mkdir(parents=True, exist_ok=True)
        self.path(file).write_text(text)

    def delete(self, file: str) -> None:
        delete(self.path(file))

    def move(self, rest: str) -> None:
        old, new = map(self.path, rest.split())
        new.parent.mkdir(parents=True, exist_ok=True)
        old.replace(new)

    def copy(self, rest: str) -> None:
        old, new = map(self.path, rest.split())
        new.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(old, new)

    def keep(self, rest: str) -> None:
        name, file = rest.split()
        self._kept[name] = split(self.path(file).read_text())[0]

    def same(self, rest: str) -> None:
        name, file = rest.split()
        assert split(self.path(file).read_text())[0] == self._kept[name]

    def has(self, rest: str, *, there: bool = True) -> None:
        file, text = rest.split(" ", 1)
        assert (text in self.path(file).read_text()) is there, self.path(file).read_text()

    def lacks(self, rest: str) -> None:
        self.has(rest, there=False)

    def only(self, rest: str) -> None:
        file, text = rest.split(" ", 1)
        assert [path for path, found in models().items() if text in found] == [self.path(file).as_posix()]

    def fresh(self, _: str) -> None:
        built = {path: re.sub(r"  // .*\n", "", text) for path, text in models().items()}
        assert built == fresh_models(Path.cwd().parent / "fresh")

    def aside(self, text: str) -> None:
        assert any(text in file.read_text() for file in Path(".urdfsync/aside").rglob("*.mo"))

    def exists(self, file: str) -> None:
        assert self.path(file).exists()

    def gone(self, file: str) -> None:
        path = self.path(file)
        listed = [each.name for each in path.parent.iterdir()] if path.parent.is_dir() else []
        assert path.name not in listed, "by case, too"

    def order(self, rest: str) -> None:
        file, *names = rest.split()
        assert sorted(self.path(file).read_text().split()) == sorted(names)

    def run(self, rest: str) -> None:
        words = rest.split()
        dry = words[:1] == ["dry"]
        words = words[dry:]
        found = {Path(path).as_posix(): str(reason) for path, reason in kinds(run(dry=dry)).items()}
        expected = dict(zip(words[::2], words[1::2], strict=True))
        assert found == {self.path(path).as_posix(): reason for path, reason in expected.items()}

    def conflicts(self, rest: str) -> None:
        assert conflicts(dry=True) == [self.path(file).as_posix() for file in rest.split()]

    def posix(self, reason: str) -> None:
        if os.name == "nt":
            pytest.skip(f"not on Windows: {reason}")

    _EXPORTS = "set", "add", "drop", "rename"
    VERBS: ClassVar[Mapping[str, Any]] = {
        "$": command,
        "$=": lambda self, rest: self.command(rest, changes=False),
        "": says,
        **{verb: lambda _, rest, verb=verb: branches.perform(f"{verb} {rest}") for verb in _EXPORTS},
        **{each.__name__: each for each in (again, begin, source, project, arm, legs)},
        **{each.__name__: each for each in (configure, config, edit, insert, note, write, delete, move, copy)},
        **{each.__name__: each for each in (unstamp, template, editor, commit, branch, git, clone)},
        **{each.__name__: each for each in (keep, same, has, lacks, aside, only, fresh, exists, gone, order)},
        **{each.__name__: each for each in (run, conflicts, posix)},
    }


@pytest.mark.parametrize(("lines", "shared"), list(scenarios()))
def test_scenarios(
    project: Path,
    execute: Execute,
    editor: Editor,
    monkeypatch: pytest.MonkeyPatch,
    lines: str,
    shared: Mapping[str, str],
) -> None:
    Scenario(execute, editor, monkeypatch, shared).play(lines)
