"""What a process remembers of its last build: it spares work, and never gives what something else was made of."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import msgspec
import pytest

from urdfsync import config, registry, uptodate
from urdfsync.build import Request, build
from urdfsync.dependencies import NO_STAT
from urdfsync.diagnostics import OutputError
from urdfsync.domain import Artifact, Import, Order, Parts, Reading, Role, Snapshot, Target
from urdfsync.planning.disk import Hashes
from urdfsync.planning.memory import Memory

SNAPSHOT: Snapshot = {"name": "n", "elements": {"R1": {"ohm": 1.0}}}
IMPORT = Import("a.csv", "hash", "hash", 1, {"rows": 2})
TARGET = Target("N", "N")


class Domain:
    """A domain that makes one file, and counts what it is asked for."""

    def __init__(self, path: str = "A.mo") -> None:
        self.asked = 0
        self.found: list[list[int]] = []
        """What was in the parts, call by call."""
        self.parts: list[Parts | None] = []
        self._path = path

    def read(self, content: bytes, file: str, options: Any, parts: Parts | None = None) -> Reading:
        self.asked += 1
        self.parts.append(parts)
        return Reading({"content": content.decode(), "file": file, "options": options}, ())

    def artifacts(
        self,
        snapshot: Snapshot,
        imports: Mapping[str, Import],
        target: Target,
        options: Any,
        parts: Parts | None = None,
    ) -> Sequence[Artifact | Order]:
        self.asked += 1
        assert parts is not None
        self.found.append([*parts])
        parts[self.asked] = "kept"
        return [Artifact(self._path, Role.RECORD, "t", {"of": (snapshot, imports, target, options)}, "part")]


MADE_OF: dict[str, Any] = {"snapshot": SNAPSHOT, "imports": {"k": IMPORT}, "target": TARGET, "options": {"a": 1}}
OTHERS: dict[str, Any] = {
    "a number": {"snapshot": {"name": "n", "elements": {"R1": {"ohm": 2.0}}}},
    "the kind of a number": {"snapshot": {"name": "n", "elements": {"R1": {"ohm": 1}}}},
    "the sign of zero": {"snapshot": {"name": "n", "elements": {"R1": {"ohm": -0.0}}}},
    "no import": {"imports": {}},
    "facts of an import": {"imports": {"k": msgspec.structs.replace(IMPORT, facts={"rows": 3})}},
    "the package": {"target": Target("M.N", "N")},
    "the class": {"target": Target("N", "M")},
    "an option": {"options": {"a": 2}},
}


def artifacts(memory: Memory, domain: Any, **made_of: Any) -> Sequence[Artifact | Order]:
    return memory.artifacts(domain, **{**MADE_OF, **made_of})


def test_files_are_made_once_as_long_as_what_they_are_made_of_is_the_same() -> None:
    memory, domain = Memory(), Domain()
    again = {"snapshot": {"elements": {"R1": {"ohm": 1.0}}, "name": "n"}}
    assert artifacts(memory, domain) is artifacts(memory, domain, **again)
    assert domain.asked == 1


@pytest.mark.parametrize("other", OTHERS.values(), ids=OTHERS)
def test_files_of_anything_else_are_made_anew(other: Mapping[str, Any]) -> None:
    memory, domain = Memory(), Domain()
    for made_of in (MADE_OF, {**MADE_OF, **other}, MADE_OF):
        (artifact,) = artifacts(memory, domain, **made_of)
        assert isinstance(artifact, Artifact)
        assert repr(artifact.data["of"]) == repr(tuple(made_of.values()))
    assert domain.asked == 3  # one package is remembered, not all


def test_files_of_another_domain_are_made_anew() -> None:
    memory, one, two = Memory(), Domain(), Domain("B.mo")
    assert [artifacts(memory, domain)[0].path for domain in (one, two)] == ["A.mo", "B.mo"]


def test_a_domain_gets_back_what_it_has_kept_and_no_other_does() -> None:
    memory, domain, other = Memory(), Domain(), Domain()
    for snapshot in ({"name": "m"}, {"name": "n"}):
        artifacts(memory, domain, snapshot=snapshot)
    artifacts(memory, other)
    artifacts(memory, domain)
    assert (domain.found, other.found) == ([[], [1], []], [[]])


def test_elements_that_are_the_same_objects_are_not_looked_into() -> None:
    memory, domain = Memory(), Domain()
    element = {"ohm": object()}  # whoever looked would find that this is no plain data
    for _ in range(2):
        artifacts(memory, domain, snapshot={"name": "n", "elements": {"R1": element}})
    assert domain.asked == 1


def test_paths_are_checked_every_time_that_they_are_no_good() -> None:
    memory, domain = Memory(), Domain("../A.mo")
    for _ in range(2):
        with pytest.raises(OutputError, match="is no path inside the package"):
            artifacts(memory, domain)


@pytest.mark.parametrize("other", [{"content": b"b"}, {"name": "g"}, {"options": 2}, {"domain": Domain()}])
def test_a_source_is_read_again_if_anything_is_another(other: Mapping[str, Any]) -> None:
    memory, usual = Memory(), {"domain": Domain(), "options": 1, "content": b"a", "name": "f"}
    assert memory.read(**usual) is memory.read(**usual)  # type: ignore[arg-type]
    asked = {**usual, **other}
    found = memory.read(**asked)
    wanted = {"content": asked["content"].decode(), "file": asked["name"], "options": asked["options"]}
    assert found.snapshot == wanted


def test_the_next_version_of_a_source_gets_what_the_domain_has_kept() -> None:
    memory, domain, usual = Memory(), Domain(), {"options": 1, "name": "f"}
    for content, other in ((b"a", {}), (b"b", {}), (b"b", {"options": 2}), (b"b", {"name": "g"}), (b"b", {})):
        memory.read(domain, content=content, **{**usual, **other})  # type: ignore[arg-type]
    assert domain.parts[0] is domain.parts[1]
    assert len({id(parts) for parts in domain.parts}) == 4, "what was kept for something else is of no use"


# What plans saw of files

STAT = (0o100644, 1, 2, 3, 4, 5)
SEEN = {f"/m/{number}.mo": (STAT, "own", "text") for number in range(9)}


CREATED = os.stat_result((0o100644, 1, 2, *[0] * 7), {"st_mtime_ns": 10**18, "st_dev": 2})
CLOCKS = [uptodate.Clock(CREATED, is_reliable=each) for each in (False, True)]
"""Of a file system on which the time of a change can be set, and of one on which it can't."""


def look(memory: Memory, seen: Hashes, trusts: bool | None = True, robot: str = "arm") -> Hashes:
    """What is remembered of a look; without a clock if `trusts` is None."""
    memory.note_look(robot, seen, uptodate.read_clocks(), lambda: None if trusts is None else CLOCKS[trusts])
    return memory.seen(robot)


def test_each_robot_has_what_was_seen_of_it_until_it_is_watched_no_more() -> None:
    memory, missing = Memory(), {"/m/gone.mo": None}
    assert memory.seen("arm") == {}
    assert look(memory, SEEN) == SEEN
    assert look(memory, missing, robot="leg") == missing
    assert memory.seen("arm") == SEEN
    memory.forget_others(["leg"])
    assert (memory.seen("arm"), memory.seen("leg")) == ({}, missing)
    assert not memory.is_current("arm")


@pytest.mark.parametrize("trusts", [None, False])
def test_a_file_that_may_change_without_a_trace_has_no_stat(trusts: bool | None) -> None:
    memory, bare = Memory(), dict.fromkeys(SEEN, (NO_STAT, "own", "text"))
    assert look(memory, SEEN, trusts) == bare
    assert look(memory, SEEN) == SEEN
    assert look(memory, {**SEEN}, trusts) == SEEN, "what was believed before is not doubted"
    memory.rehash_all()
    assert memory.seen("arm") == bare


def test_a_few_files_are_read_again_and_no_clock_is_read_for_them() -> None:
    memory, few = Memory(), dict(list(SEEN.items())[:4])
    memory.note_look("arm", few, uptodate.read_clocks(), lambda: pytest.fail("a clock was read"))
    assert memory.seen("arm") == dict.fromkeys(few, (NO_STAT, "own", "text"))


def test_what_was_seen_counts_until_a_build_writes_or_another_plan_begins() -> None:
    memory = Memory()
    assert not memory.is_current("arm")
    look(memory, SEEN)
    assert memory.is_current("arm")
    memory.invalidate("arm")
    assert not memory.is_current("arm")
    assert memory.seen("arm") == SEEN


def test_templates_of_the_program_are_read_once_until_nothing_is_trusted() -> None:
    memory, found = Memory(), iter([{"a": "1"}, {"a": "2"}, {"a": "3"}])
    assert [memory.shipped(folder, lambda: next(found)) for folder in "xxyx"] == [{"a": "1"}] * 2 + [
        {"a": "2"},
        {"a": "1"},
    ]
    memory.rehash_all()
    assert memory.shipped("x", lambda: next(found)) == {"a": "3"}


# Builds with a memory, beside builds of processes that have none


def _replace(path: Path, old: str, new: str) -> None:
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


def _settings(line: str) -> Callable[[Path], None]:
    return lambda project: _replace(project / "urdfsync.toml", "[robots.ladder]\n", f"[robots.ladder]\n{line}\n")


def _source(old: str, new: str) -> Callable[[Path], None]:
    return _edit("ladder.json", old, new)


def _edit(name: str, old: str, new: str) -> Callable[[Path], None]:
    return lambda project: _replace(project / name, old, new)


def _each(project: Path, *changes: Callable[[Path], None]) -> None:
    for change in changes:
        change(project)


def _own_template(project: Path) -> None:
    """A template of the user's in the place of the domain's."""
    domain = registry.domain("rcnetwork")
    assert domain.templates is not None
    (project / "own").mkdir()
    for file in sorted(domain.templates.rglob("*.jinja")):
        place = project / "own" / file.relative_to(domain.templates)
        place.parent.mkdir(exist_ok=True)
        shutil.copy(file, place)
        place.write_text(place.read_text() + "// mine\n")
    _settings('templates = "own"')(project)


def _old_manifest(project: Path) -> None:
    """The recorded state of the first build, as if somebody had gone back in version control."""
    for file in (project / "first").iterdir():
        shutil.copy(file, project / ".urdfsync/robots" / file.name)


STEPS: dict[str, Callable[[Path], None]] = {
    "a number": _source('"ohm": 100', '"ohm": 700'),
    "nothing": lambda project: None,
    "the number again": _source('"ohm": 700', '"ohm": 100'),
    "an option": _settings('prefix = "pin"'),
    "an option and a number": lambda project: _each(
        project, _edit("urdfsync.toml", '"pin"', '"knot"'), _source('"ohm": 100', '"ohm": 800')
    ),
    "templates": _own_template,
    "a template": lambda project: _replace(
        next(iter(sorted((project / "own").rglob("*.jinja")))), "// mine", "// ours"
    ),
    "the record of an older build": _old_manifest,
    "the package": lambda project: _replace(project / "urdfsync.toml", '"Ladder"', '"Steps"'),
    "a generated file": lambda project: next(iter(sorted((project / "modelica/Steps").glob("*.mo")))).unlink(),
    "the whole record": lambda project: shutil.rmtree(project / ".urdfsync"),
}


def test_builds_with_a_memory_write_what_builds_without_one_write(rc_domain: None, tmp_path: Path) -> None:
    examples = Path(__file__).parents[1] / "rcnetwork/examples"
    memory, projects = Memory(), [tmp_path / "with", tmp_path / "without"]
    for project in projects:
        shutil.copytree(examples, project)
        settings = 'source = "ladder.json"\npackage = "Ladder"\ndomain = "rcnetwork"\n'
        (project / "urdfsync.toml").write_text(f"[robots.ladder]\n{settings}")
    written = {}
    for step, change in {"nothing yet": lambda project: None, **STEPS}.items():
        for project, remembered in zip(projects, (memory, None), strict=True):
            change(project)
            loaded = config.load(project / "urdfsync.toml")
            (result,) = build(loaded, loaded.robots, Request(memory=remembered))
            assert not result.failed, result.diagnostics
            if not (project / "first").exists():
                shutil.copytree(project / ".urdfsync/robots", project / "first")
        found, wanted = ({p.relative_to(q): p.read_bytes() for p in q.rglob("*") if p.is_file()} for q in projects)
        assert found == wanted, step
        written[step] = found
    one, other = ({p: b for p, b in written[step].items() if p.suffix == ".mo"} for step in ("nothing yet", "a number"))
    assert one != other
