"""Random walks of two branches that export, edit and build tree-shaped robots, and that git brings together.

No command stops, no edit and no export gets lost, all verdicts agree, and none is green on what git merged wrongly.
`URDFSYNC_REPLAYS=1200` makes 300 walks of four meetings each, with fresh seeds or those from `URDFSYNC_SEED`.
"""

from __future__ import annotations

import collections
import difflib
import hashlib
import re
import shutil
import subprocess
from collections.abc import Iterator, Mapping
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import pytest
from lxml import etree
from support import edits, replay, tree_changes
from support.commands import Execute, Printed
from support.git import NEEDS_GIT, Repository
from support.urdfs import joint, limit, link

from urdfsync.engine import decide

pytestmark = [NEEDS_GIT, pytest.mark.slow]

MEETINGS = 4
WALKS = replay.STEPS // MEETINGS or 6
SOURCE, PACKAGE = Path("arm.urdf"), Path("modelica/Arm")
WAYS = ("merge -q --no-edit theirs", "rebase -q theirs", "cherry-pick --keep-redundant-commits {start}..theirs")
ANSWERS = ("--merge", "--merge --prefer mine", "--merge --prefer generated", "--keep", "--take")
_TAG = re.compile(r"mine\d{6}|7171\.\d{6}")
_NUMBER = re.compile(r"(?<== )\d+(?:\.\d+)?(?=[,)])")
_OWN = re.compile(r"(?m)^.*(?:mine\d{6}).*\n")
_DECLARED = re.compile(r"(?m)^  (?:(?:final|parameter|replaceable|inner|outer) )*[A-Z][\w.]* (\w+)")
_COMMENT = re.compile(r"(?m)//.*$|\"(?:[^\"\\]|\\.)*\"")


# Exports


def export(robot: etree._Element) -> None:
    """Write the robot, with a blank line between its elements, so that git merges neighbours."""
    lines = [etree.tostring(element, encoding="unicode", with_tail=False) for element in robot]
    SOURCE.write_text("\n\n".join(['<robot name="arm">', *lines, "</robot>", ""]))


def first_robot(random: Random) -> etree._Element:
    """A small tree."""
    links = ["base", "upper", "fore", "hand", "tool", "camera"][: random.randint(3, 6)]
    joints = [
        joint(f"{child}_joint", random.choice(["revolute", "continuous", "fixed"]), parent, child, axis="0 1 0")
        for place, child in enumerate(links[1:], start=1)
        for parent in [random.choice(links[max(0, place - 2) : place])]
    ]
    elements = "\n".join([*(link(name, 1.0 + place) for place, name in enumerate(links)), *joints])
    return etree.fromstring(f"<robot>{elements}</robot>")


def change(robot: etree._Element, random: Random, number: int) -> etree._Element:
    """The robot after one change; where the kind does not apply, as it was."""
    joints, names = robot.findall("joint"), {one.get("name") for one in robot}
    match random.choice(["number", "number", "number", "add", "rename", "rename", "tree", "tree"]):
        case "number":
            places = [*robot.iter("mass", "limit", "origin")]
            place = random.choice(places)
            key, value = {"mass": ("value", "2.{}"), "limit": ("effort", "4{}"), "origin": ("xyz", "0.{} 0 0.5")}[
                str(place.tag)
            ]
            place.set(key, value.format(random.choice([number, random.randint(1, 3)])))
        case "add":
            name = random.choice([f"part{number}", f"part{random.randint(1, 3)}"])
            if name not in names:
                parent = str(random.choice(robot.findall("link")).get("name"))
                new = joint(f"{name}_joint", "revolute", parent, name, axis="0 0 1", inside=[limit()])
                robot.append(etree.fromstring(link(name, 3)))
                robot.append(etree.fromstring(new))
        case "rename":
            one = random.choice([*robot.findall("link"), *joints])
            old, new_name = one.get("name"), f"{str(one.get('name')).split('_')[0]}_{random.choice('xyz')}"
            if new_name not in names:
                one.set("name", new_name)
                for end in robot.iter("parent", "child") if one.tag == "link" else ():
                    if end.get("link") == old:
                        end.set("link", new_name)
        case _:
            kinds = ["another parent", "a link in between", "a link less", "links exchanged"]
            changed = tree_changes.changed(etree.tostring(robot), random.choice(kinds), random)
            return robot if changed is None else etree.fromstring(changed)
    return robot


# Edits


def edit(random: Random, number: int) -> None:
    """One edit as people make them; each line of it has a tag."""
    path = random.choice(sorted(PACKAGE.rglob("*.mo")))
    robot = PACKAGE / "Arm.mo"
    path = robot if random.random() < 0.4 and robot.exists() else path
    text, tag = path.read_text(), f"mine{900000 + number}"
    blanks = [place.start() + 1 for place in re.finditer(r"\n(?=\n?equation\n|\n?  annotation \(\n?  )", text)]
    kind = random.choice(["comment", "component", "number", "number", "sensor", "sensor"])
    if kind == "comment":
        text = re.sub(r"\n(end \w+;\n*)$", rf"\n  // {tag}\n\1", text)
    elif kind == "component" and blanks and "\nmodel " in text:
        text = f'{text[: blanks[0]]}  Modelica.Blocks.Sources.Constant {tag}(k = 3) "Mine";\n{text[blanks[0] :]}'
    elif kind == "sensor" and (ends := re.findall(r"connect\((\w+\.frame_[ab]), ", text)) and "\nequation\n" in text:
        head, _, rest = text.partition("\nequation\n")
        sensor = f"  Modelica.Mechanics.MultiBody.Sensors.AbsoluteSensor {tag};\n"
        connection = f'  connect({random.choice(ends)}, {tag}.frame_a) "mine{800000 + number}";\n'
        text = f"{head}{sensor}\nequation\n{connection}{rest}"
    elif kind == "number" and (places := list(_NUMBER.finditer(text))) and path.stem.endswith("Parameters"):
        place = random.choice(places)
        text = f"{text[: place.start()]}7171.{900000 + number}{text[place.end() :]}"
    path.write_text(text)


def tags(*folders: Path) -> set[str]:
    """The tags below these folders, but for the bases."""
    files = (path for folder in folders for path in folder.rglob("*") if path.is_file() and "bases" not in path.parts)
    return {tag for path in files for tag in _TAG.findall(path.read_bytes().decode(errors="replace"))}


def is_but_for_edits(text: str, generated: str) -> bool:
    """Whether a text is a generated one with nothing but tagged lines and numbers in it."""
    mine = [line for line in _OWN.sub("", text).splitlines() if line.strip()]
    other = [line for line in generated.splitlines() if line.strip()]
    patterns = (re.sub(r"7171\\\.\d{6}", r"[-\\w.+]+", re.escape(line)) for line in mine)
    return len(mine) == len(other) and all(map(re.fullmatch, patterns, other))


def difference(text: str, generated: str) -> Iterator[str]:
    """The lines that differ."""
    return difflib.unified_diff(generated.splitlines(), text.splitlines(), "generated", "mine", lineterm="", n=1)


def texts(package: Path = PACKAGE) -> dict[str, str]:
    """The package, by paths below it."""
    files = (path for path in sorted(package.rglob("*")) if path.suffix in (".mo", ".order"))
    return {path.relative_to(package).as_posix(): path.read_bytes().decode().replace("\r\n", "\n") for path in files}


def missing_names(found: Mapping[str, str]) -> Iterator[str]:
    """Links, joints and parts that a text names, and that are nowhere. This does not ask urdfsync."""
    for path, text in found.items():
        if not path.endswith(".mo"):
            continue
        code = _COMMENT.sub("", text)
        for folder, name in re.findall(r"(?<![\w.])(Links|Joints)\.(\w+)", code):
            if not {f"{folder}/{name}.mo", f"{folder}/{name}/package.mo"} & found.keys():
                yield f"{path}: {folder}.{name}"
        if path == "Arm.mo":
            used = {name for ends in re.findall(r"connect\((\w+)\.\w+, (\w+)\.", code) for name in ends}
            yield from (f"{path}: {name}" for name in used - set(_DECLARED.findall(code)))


class Verdict(NamedTuple):
    """What `status` and `build --check` say alike."""

    in_step: bool
    conflicts: tuple[str, ...]
    broken: tuple[str, ...]
    """The files that do not fit."""


class Walk:
    """Two branches of one project, and whoever works on them."""

    def __init__(self, random: Random, repository: Repository, execute: Execute, work: Path) -> None:
        self.random, self.repository, self.execute, self.work = random, repository, execute, work
        self.number, self.log, self.tally = 0, list[str](), collections.Counter[str]()
        self.is_wild = random.random() < 0.25
        """Whether edits of all kinds are made, such as deleted lines."""
        self.hand = edits.Hand(random)
        self.odd: set[str] | None = None
        """Of these files, those that do; None after a build that left anything to do."""
        self.gives_up = False
        """Whether edits have been given up since the last build, be it that this waits; they are put aside."""
        self.status: Mapping[str, Any] = {}
        """What `status` said last of each file."""
        self.built = dict[str, dict[str, str]]()
        """Fresh packages by their source."""
        self.frees = {"main": set[str]()}
        self.free = self.frees["main"]
        """Files that may differ from a fresh build: the user said so, or git has made something of two of them.

        By branch, and for the one that is checked out.
        """
        approach = random.choice(['["package"]'] * 4 + ['["record"]', '["package", "record"]'])
        merging = random.choice(["", 'on_conflict = "merge"\n'])
        self.configuration = f'[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\napproach = {approach}\n{merging}'
        Path("urdfsync.toml").write_text(self.configuration)
        export(first_robot(random))
        if random.random() < 0.15:
            Path(".gitattributes").write_text("*.mo merge=urdfsync\n")
            execute("merge-driver", "--install")
        self.build()
        repository.commit()

    def run(self, command: str, *, code: int | None = None) -> Printed:
        """Run a command; only errors that name the source or merge markers are allowed, if none is asked for."""
        self.log.append(command)
        printed = self.execute(*command.split(), code=code)
        assert "Traceback" not in printed.words
        if printed.code == 2:
            assert "merge markers" in printed.words or SOURCE.name in printed.words, printed.words
        return printed

    def git(self, *arguments: str) -> bool:
        """Run git; whether it succeeded."""
        self.log.append(f"git {' '.join(arguments)}")
        return not subprocess.run(["git", *arguments], capture_output=True).returncode

    # What a command says

    def verdict(self) -> Verdict:
        """Ask all commands that judge, none of which writes."""
        before = self.everything()
        documents = [self.run(command) for command in ("status --json", "build --check --json")]
        (status,), (check,) = (printed.json["robots"] for printed in documents)
        assert status["in_step"] == check["in_step"]
        assert [printed.code == 0 for printed in documents] == [status["in_step"]] * 2
        standing = [one for one in status["actions"] if one["status"]]
        self.status = {
            one["origin"] if one["action"] == "conflict" and one["origin"] else one["path"]: one for one in standing
        }
        if self.random.random() < 0.3 and not self.repository.git("status", "--porcelain"):
            assert (self.run("hook check").code == 0) == status["in_step"]
        assert self.everything() == before
        conflicts = tuple(one["path"] for one in check["actions"] if one["action"] == "conflict")
        self.tally.update(verdicts=1, broken=check["broken"], conflicts=bool(conflicts), green=check["in_step"])
        files = {one["file"] for one in check["diagnostics"] if one["severity"] != "note" and one["file"]}
        broken = tuple(sorted(files & self.status.keys())) if check["broken"] else ()
        return Verdict(check["in_step"], conflicts, broken)

    def everything(self) -> dict[str, bytes]:
        """All that version control has."""
        found = replay.contents(PACKAGE)
        return found | replay.contents(Path(".urdfsync/robots")) | replay.contents(Path(".urdfsync/bases"))

    # What a user does

    def build(self) -> None:
        """Build, answer conflicts, and see that nothing is lost; what is broken is mended at last."""
        verdict, self.odd, self.gives_up = self.verdict(), None, False
        before, there = tags(PACKAGE), self.everything()
        command = "build --full" if self.random.random() < 0.2 else "build"
        printed = self.run(f"{command} --json")
        assert printed.code in (0, 3), printed.json["robots"]
        self.follow_moves(printed.json["robots"])
        assert not before - tags(PACKAGE), ("lost", before - tags(PACKAGE))
        if verdict.in_step:
            assert printed.code == 0
            assert command != "build" or self.everything() == there, "in step, but written"
        verdict = self.agree(printed.code)
        for answer in (*self.random.sample(ANSWERS, 2), "--keep", "--take"):
            if not verdict.conflicts:
                break
            verdict = self.answer(answer, verdict)
        assert not verdict.conflicts, verdict
        if verdict.broken and self.random.random() < 0.8:
            verdict = self.mend(verdict)
        if verdict.in_step:
            self.compare()

    def build_last(self) -> None:
        """Build where no commit of git's comes after it: what equals a fresh build has to stay so."""
        self.build()
        if self.odd is not None:
            self.free &= self.odd

    def agree(self, code: int) -> Verdict:
        """The verdict after a build that ended with this code; another build writes nothing."""
        verdict, there = self.verdict(), self.everything()
        assert verdict.in_step == (code == 0), (code, verdict)
        if self.random.random() < 0.3:
            assert self.run("build").code == code
            assert self.everything() == there, "a second build writes"
        return verdict

    def answer(self, answer: str, verdict: Verdict) -> Verdict:
        before = tags(PACKAGE)
        printed = self.run(f"resolve --all {answer} --json")
        self.follow_moves(printed.json["robots"])
        if answer in ("--keep", "--merge --prefer mine"):
            self.free |= {path.removeprefix(f"{PACKAGE.as_posix()}/") for path in verdict.conflicts}
        self.gives_up |= answer.endswith(("take", "generated"))
        places = [PACKAGE, Path(".urdfsync")] if self.gives_up else [PACKAGE]
        assert not before - tags(*places), ("lost", answer, before - tags(*places))
        verdict = self.verdict()
        assert printed.code in ((0,) if verdict.in_step else (3,)), printed
        return verdict

    def mend(self, verdict: Verdict) -> Verdict:
        """What somebody does whose edits do not fit: out with them; else the generated text."""
        for name in verdict.broken:
            Path(name).write_text(_OWN.sub("", Path(name).read_text()))
        verdict = self.verdict()
        for path in verdict.broken:
            self.run(f"resolve {path} --take")
        code = self.run("build").code
        verdict = self.verdict()
        assert verdict.in_step or self.is_wild or self.free, (code, verdict)
        return verdict

    def follow_moves(self, robots: Any) -> None:
        """What may differ may differ where it moves to."""
        inside = f"{PACKAGE.as_posix()}/"
        paths = [(one["reason"], one["path"].removeprefix(inside)) for one in robots[0]["actions"]]
        if self.free & {path for reason, path in paths if reason == "moved-away"}:
            self.free |= {path for reason, path in paths if reason == "move"}

    # What must hold

    def fresh(self) -> dict[str, str]:
        """The package as it is built from the source alone."""
        source = SOURCE.read_text()
        if source not in self.built:
            shutil.rmtree(self.work, ignore_errors=True)
            self.work.mkdir()
            shutil.copy(SOURCE, self.work)
            (self.work / "urdfsync.toml").write_text(self.configuration)
            self.execute("build", "--config", self.work / "urdfsync.toml")
            self.built[source] = texts(self.work / PACKAGE)
        return self.built[source]

    def compare(self) -> None:
        """What is green names nothing that is not there; but for edits it is a fresh package."""
        found, wanted = texts(), self.fresh()
        missing = list(missing_names(found))
        assert not missing, f"green, and names nothing: {missing}"
        odd = {
            path
            for path in found.keys() | wanted.keys()
            if path not in found or not is_but_for_edits(found[path], wanted.get(path, ""))
        }
        self.odd = odd & self.free
        self.tally.update(
            compared=1, edited=sum(bool(_TAG.search(text)) for text in found.values()), free=len(self.free)
        )
        for path in sorted(odd - self.free):
            state = self.status.get(f"{PACKAGE.as_posix()}/{path}")
            is_left = path not in wanted and (state is None or state["reason"] in ("orphan", "needed"))
            has_edits = self.is_wild and (state is None or state["reason"] in ("keep", "included"))
            is_order = path.endswith("package.order") and set(wanted.get(path, "").split()) <= set(found[path].split())
            assert is_left or has_edits or is_order, "\n".join(
                [f"{path}: {state}", *difference(found.get(path, ""), wanted.get(path, ""))]
            )

    # Steps

    def work_on(self, branch: str) -> None:
        """Exports and edits on a branch from `main`, each built and committed."""
        self.git("checkout", "-q", "-B", branch, "main")
        self.free = self.frees[branch] = {*self.frees["main"]}
        for _ in range(self.random.choice([1, 1, 2])):
            for _ in range(self.random.choice([0, 1, 2])):
                self.number += 1
                if self.is_wild and self.random.random() < 0.5:
                    self.hand.edit(PACKAGE)
                else:
                    edit(self.random, self.number)
            for _ in range(self.random.choice([0, 1, 1, 2])):
                self.number += 1
                export(
                    change(
                        etree.parse(SOURCE, etree.XMLParser(remove_blank_text=True)).getroot(), self.random, self.number
                    )
                )
            if self.random.random() < 0.9:
                self.build_last()
            self.repository.commit()

    def meet(self) -> None:
        """Git brings both branches together, and one build what came of that in step."""
        start = self.repository.git("merge-base", "ours", "theirs").strip()
        self.git("checkout", "-q", "ours")
        self.free = self.frees["main"] = self.frees["ours"] | self.frees["theirs"]
        self.git(*self.random.choice(WAYS).format(start=start).split())
        self.settle()
        for _ in range(20):
            if Path(".git/rebase-merge").exists():
                self.git("-c", "core.editor=true", "rebase", "--continue")
            elif Path(".git/sequencer").exists():
                self.git("commit", "-q", "--allow-empty", "--no-edit", "-m", "settled")
                self.git("-c", "core.editor=true", "cherry-pick", "--continue")
            else:
                break
            self.settle()
        else:
            raise AssertionError("git does not end")
        self.git("commit", "-q", "--allow-empty", "-m", "settled")
        if self.random.random() < 0.3:
            self.git("clean", "-fdxq")  # as a clone has it
        self.mark_mixtures()
        self.build_last()
        self.repository.commit()
        self.git("checkout", "-q", "-B", "main")

    def settle(self) -> None:
        """Take one side of each file that git can't merge, never of recorded states."""
        unmerged = sorted(set(self.repository.git("diff", "--name-only", "--diff-filter=U").split()))
        assert not [path for path in unmerged if path.startswith(".urdfsync/")]
        self.tally["settled"] += len(unmerged)
        if unmerged and self.random.random() < 0.2:
            self.run("status")
            has_markers = any(b"<<<<<<< " in Path(path).read_bytes() for path in unmerged if Path(path).exists())
            assert self.run("build --dry-run").code == 2 or not has_markers
        all_sides = self.random.choice(["ours", "theirs", ""])
        for path in unmerged:
            side = all_sides or self.random.choice(["ours", "theirs"])
            if not self.git("checkout", f"--{side}", "--", path):  # that side has deleted it
                Path(path).unlink(missing_ok=True)
            elif b"<<<<<<< " in Path(path).read_bytes():  # of two renames to one path, git marks the sides themselves
                if not self.git("checkout", "theirs", "--", path):
                    Path(path).unlink()
            elif Path(path).is_relative_to(PACKAGE):  # an edited one may lack what the other side's export brought
                name = Path(path).relative_to(PACKAGE).as_posix()
                if texts().get(name) not in [package.get(name) for package in self.built.values()]:
                    self.free.add(name)
        if self.run("status").code == 2:
            assert SOURCE.name in self.run("status", code=2).words
            self.git("checkout", "-q", "theirs", "--", SOURCE.as_posix())
        if self.random.random() < 0.2:
            self.mark_mixtures()
            self.build()
        self.git("add", "-A")

    def mark_mixtures(self) -> None:
        """Texts that git has made of two generated ones count as edits: nobody can tell them from such.

        So do those of a side that was taken, whose generated text is not in the bases of the other.
        """
        bases = b"".join(replay.contents(Path(".urdfsync/bases")).values())
        for path, text in texts().items():
            generated = (package[path] for package in self.built.values() if path in package)
            known = [text for text in generated if hashlib.sha256(text.encode()).hexdigest().encode() in bases]
            if not any(is_but_for_edits(text, base) for base in known):
                self.free.add(path)


def walk(seed: int, folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    """Make one walk; what was counted is printed, and what was done if it fails."""
    repository = Repository(folder / "project", monkeypatch)
    monkeypatch.chdir(repository.folder)
    one = Walk(Random(seed), repository, execute, folder / "fresh")
    try:
        for _ in range(MEETINGS):
            for branch in one.random.sample(["ours", "theirs"], 2):
                one.work_on(branch)
            one.meet()
    except BaseException as error:
        error.add_note("\n".join([f"seed {seed}", *one.log]))
        raise
    print(seed, one.is_wild, dict(one.tally))  # noqa: T201


@pytest.mark.parametrize("seed", range(replay.SEED, replay.SEED + WALKS))
def test_a_walk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute, in_haste: None, seed: int) -> None:
    walk(seed, tmp_path, execute, monkeypatch)


def test_a_lost_edit_would_be_found(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute, in_haste: None
) -> None:
    def careless(*arguments: object, code: int | None = 0) -> Printed:
        printed = execute(*arguments, code=code)
        for path in PACKAGE.rglob("*.mo") if arguments in (("build",), ("build", "--json")) else ():
            path.write_text(_OWN.sub("", path.read_text()))
        return printed

    with pytest.raises(AssertionError, match="lost"):
        walk(1000, tmp_path, careless, monkeypatch)


def test_a_green_verdict_of_what_is_broken_would_be_found(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute, in_haste: None
) -> None:
    repository = Repository(tmp_path / "project", monkeypatch)
    monkeypatch.chdir(repository.folder)
    one = Walk(Random(1), repository, execute, tmp_path / "fresh")
    robot = PACKAGE / "Arm.mo"
    robot.write_text(
        robot.read_text().replace("equation\n", "equation\n  connect(base.frame_a, mine900001.frame_a);\n")
    )
    monkeypatch.setattr(decide, "find_misfits", lambda *_: ())
    with pytest.raises(AssertionError, match="green, and names nothing"):
        one.build()
