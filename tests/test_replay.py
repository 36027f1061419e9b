"""Replays of the corpus's histories: each version, built over the one before, equals a fresh build, and edits follow.

`URDFSYNC_REPLAYS=1` replays all histories, not only some small ones. `test_state_machine` edits files in between.
"""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import msgspec
import pytest
from support import replay
from support.packages import read
from support.replay import Files, Fresh, Project, Stamps, without_former

from urdfsync.domain import ChangeClass
from urdfsync.domain.matching import match
from urdfsync.engine.result import Result
from urdfsync.engine.sources.translators import is_xacro
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.project.state import statefile

SMALL = ("turtlebot3_burger", "so101_old_calib", "urdf_spirit_meshes")
"""Histories with steps of every class, renames and an invalid version."""
CHOSEN = {name: all_of for name, all_of in replay.histories().items() if replay.STEPS or name.endswith(SMALL)}
MINE = "  // mine: has to follow its element"
REACH = {ChangeClass.NONE: set(), ChangeClass.UNMODELLED: set(), ChangeClass.PARAMETER: {"record", "import"}}
"""By class of a step: roles of the files that the step may write."""
BELOW = f"{replay.PACKAGE}/"

pytestmark = pytest.mark.slow
each_history = pytest.mark.parametrize("name", CHOSEN or ["no-corpus"], ids=lambda name: name[-40:])


@each_history
@pytest.mark.parametrize("meshes", [False, True], ids=["no-meshes", "meshes"])
def test_each_version_over_the_last_is_a_fresh_build(corpus: Path, tmp_path: Path, name: str, meshes: bool) -> None:
    tally = replayed(CHOSEN[name], tmp_path, base=replay.base_of(CHOSEN[name]), meshes=meshes)
    assert replay.STEPS or tally["unwritten"] > 0


def test_a_long_history_of_different_robots(corpus: Path, tmp_path: Path) -> None:
    versions = list(itertools.chain.from_iterable(CHOSEN.values()))
    assert replayed(versions, tmp_path, base="fixed", meshes=False)[ChangeClass.STRUCTURAL] > 3


def replayed(versions: Sequence[bytes], work: Path, *, base: str, meshes: bool) -> Counter[str]:
    """Build each version over the version before; return counts."""
    tally, built = Counter[str](), dict[str, bytes]()
    project, fresh = Project(work / "project", base, meshes=meshes), Fresh(work / "fresh", base, meshes=meshes)
    for number, content in enumerate(versions):
        before = project.stamps()
        project.save(content)
        result = project.build()
        assert list(faults(project, before, result, built, *fresh(content))) == [], f"version {number}"
        if not result.failed:
            tally[class_of(result)] += bool(built)
            built, after = dict(project.files()), project.stamps()
            tally["unwritten"] += sum(before.get(path) == stamp for path, stamp in after.items() if BELOW in path)
    return tally


def lacks_unmodelled(path: str, result: Result, found: bytes | None, wanted: bytes | None) -> bool:
    """Whether a recorded state lacks only facts that no file of the package contains, for which no build writes it.

    Former names tell how the state came about.
    """
    if result.changes is None or result.changes.change_class is not ChangeClass.UNMODELLED:
        return False
    if not path.endswith(".state") or found is None or wanted is None:
        return False
    (old,), (new,) = (statefile.loads(text.decode(), path)[0] for text in (found, wanted))
    history = {"former": old.former, "former_ids": old.former_ids, "ids": old.ids, "edits": old.edits}
    return old == msgspec.structs.replace(new, snapshot=old.snapshot, ancestors=old.ancestors, **history)


def faults(project: Project, before: Stamps, result: Result, old: Files, package: Files, state: Files) -> Iterator[str]:
    """The faults after a build over the `old` package; a fresh build gives this `package` and `state`."""
    after = project.stamps()
    touched = {path for path in before.keys() | after.keys() if before.get(path) != after.get(path)}
    touched = {path for path in touched if path.startswith((".urdfsync/", BELOW))}
    if result.failed or not package:
        yield from ["a version is built here or fresh, and refused there"] if package or not result.failed else []
        yield from (f"{path} changed in spite of an error" for path in touched - {".urdfsync/.gitignore"})
        return
    for wanted, found in ((package, project.files()), (state, project.state())):
        both = wanted.keys() | found.keys()
        yield from (
            f"{path} differs from a fresh build"
            for path in both
            if without_former(found.get(path)) != without_former(wanted.get(path))
            and not lacks_unmodelled(path, result, found.get(path), wanted.get(path))
        )
    written = {path.removeprefix(BELOW) for path in touched if path.startswith(BELOW)}
    yield from (f"{path} is written with its own bytes" for path in written if old.get(path) == package.get(path))
    if old and (allowed := REACH.get(class_of(result))) is not None:
        roles = {action.path.removeprefix(BELOW): str(action.role) for action in result.actions}
        yield from (f"a {class_of(result)} step writes {path}" for path in written if roles[path] not in allowed)
    project.build()
    yield from ["a second build writes"] if project.stamps() != after else []


def class_of(result: Result) -> ChangeClass:
    return result.changes.change_class if result.changes else ChangeClass.NONE


@each_history
def test_edits_follow_elements_with_another_name(corpus: Path, tmp_path: Path, name: str) -> None:
    """The test edits each element that a step only renames; the edit must move to the renamed element's model."""
    plain = [content for content in CHOSEN[name] if not is_xacro(Path("bot.urdf"), content)]  # xacro makes other names
    readable = [(content, found) for content in plain if (found := read(content).snapshot) is not None]
    count = 0
    for (old, before), (new, after) in itertools.pairwise(readable):
        for (kind, element), renamed in match(DOMAIN.features(before), DOMAIN.features(after)).renames.items():
            count += 1
            project = Project(tmp_path / str(count))
            project.save(old)
            project.build()
            path = model_of(project, f"{kind} {element}")
            lines = path.read_text().split("\n")
            lines.insert(len(lines) // 2, MINE)
            path.write_text("\n".join(lines))
            project.save(new)
            result = project.build()
            target = model_of(project, f"{kind} {renamed}")
            assert MINE in target.read_text().split("\n"), (kind, element, renamed)
            # another part may have the old name now
            assert target == path or not path.exists() or MINE not in path.read_text()
            assert not result.conflicts
    assert replay.STEPS or count or name.endswith(("spirit_meshes", "turtlebot3_burger"))


def model_of(project: Project, owner: str) -> Path:
    (path,) = (one.path for one in project.build().actions if (one.owner, one.role) == (owner, "model"))
    return project.root / path
