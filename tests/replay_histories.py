"""Replays the histories of the corpus: builds each version over the one before, and compares with a fresh build.

`python tests/replay_histories.py [NAME …]` prints a row for each history whose name contains a NAME (all without
any), without meshes and with made-up ones, then all of them as one long history of one robot. The exit code is 1 if
anything is not as it should be. `tests/test_replay.py` runs a part of it.
"""

from __future__ import annotations

import collections
import itertools
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from support import replay
from support.replay import Built, Fresh, Project, Stamps

from urdfsync.domain import ChangeClass
from urdfsync.outcome import Result
from urdfsync.urdf.domain import DOMAIN

REFUSED = "refused"
CLASSES = [str(change_class) for change_class in ChangeClass]
COLUMNS = ("versions", REFUSED, *CLASSES, "written", "unwritten", "deleted", "renames", "failures")
MINE = "  // mine: has to follow its element"
LONG = "all of them, one after the other"
WORST = {ChangeClass.NONE: set(), ChangeClass.UNMODELLED: set(), ChangeClass.PARAMETER: {"record", "import"}}
"""Roles of the files that a step of a class may write."""


class Tally(collections.Counter[str]):
    """What was counted in one history, and what was wrong."""

    def __init__(self) -> None:
        super().__init__()
        self.failures: list[str] = []

    def check(self, holds: bool, message: str) -> None:
        """Note a failure if something does not hold."""
        if not holds:
            self["failures"] += 1
            self.failures.append(message)


def replayed(versions: Sequence[bytes], work: Path, *, base: str, meshes: bool) -> Tally:
    """Build the versions one over the other."""
    tally = Tally()
    project = Project(work / "project", base, meshes=meshes)
    fresh = Fresh(work / "fresh", base, meshes=meshes)
    built = Built({}, {})
    for number, content in enumerate(versions):
        before = project.stamps()
        project.save(content)
        result = project.build()
        tally["versions"] += 1
        found = list(_wrong(project, before, result, built, fresh(content)))
        tally.check(not found, f"version {number}: {'; '.join(found)}")
        if result.failed:
            tally[REFUSED] += 1
            continue
        after = project.stamps(replay.PACKAGE)
        was = _below_package(before)
        if built.files:
            tally[str(_class_of(result))] += 1
            tally["written"] += sum(was.get(path) != stamp for path, stamp in after.items())
            tally["unwritten"] += sum(was.get(path) == stamp for path, stamp in after.items())
            tally["deleted"] += len(was.keys() - after.keys())
        built = fresh(content)
    return tally


def _wrong(project: Project, before: Stamps, result: Result, old: Built, new: Built) -> Iterator[str]:
    """What is not as it should be after a build of the version whose fresh build is `new`, over that of `old`."""
    after = project.stamps()
    touched = {path for path in before.keys() | after.keys() if before.get(path) != after.get(path)}
    touched = {path for path in touched if path.startswith((".urdfsync/", f"{replay.PACKAGE}/"))}
    if result.failed or not new.files:
        yield from ["what a fresh build refuses is built"] if not result.failed else []
        yield from ["what a fresh build makes is refused"] if new.files else []
        yield from (f"{path} changed in spite of an error" for path in touched - {".urdfsync/.gitignore"})
        return
    files, state = project.files(), project.state()
    yield from (
        f"{p} differs from a fresh build" for p in files.keys() | new.files.keys() if files.get(p) != new.files.get(p)
    )
    yield from (f"{p} differs from that of a fresh build" for p in state if state[p] != new.state.get(p))
    written = {path.removeprefix(f"{replay.PACKAGE}/") for path in touched if path.startswith(replay.PACKAGE)}
    yield from (
        f"{path} is written with the bytes it had" for path in written if old.files.get(path) == files.get(path)
    )
    if old.files and (allowed := WORST.get(_class_of(result))) is not None:
        roles = {a.path.removeprefix(f"{replay.PACKAGE}/"): str(a.role) for a in result.actions}
        yield from (f"a {_class_of(result)} step writes {path}" for path in written if roles[path] not in allowed)
    project.build()
    yield from ["a second build writes"] if project.stamps() != after else []


def _class_of(result: Result) -> ChangeClass:
    return result.changes.change_class if result.changes else ChangeClass.NONE


def _below_package(stamps: Stamps) -> Stamps:
    prefix = f"{replay.PACKAGE}/"
    return {path.removeprefix(prefix): stamp for path, stamp in stamps.items() if path.startswith(prefix)}


def renames(versions: Sequence[bytes], work: Path, *, base: str) -> Tally:
    """Edit each element that a step only renames, and see whether the edit is in the renamed element's model then."""
    tally = Tally()
    readable = [content for content in versions if replay.snapshot_of(content) is not None]
    for number, (old, new) in enumerate(itertools.pairwise(readable)):
        before, after = replay.snapshot_of(old), replay.snapshot_of(new)
        assert before is not None
        assert after is not None
        for (kind, name), renamed in DOMAIN.renames(before, after).items():
            tally["renames"] += 1
            place = work / f"rename-{number}-{tally['renames']}"
            wrong = _lost(Project(place, base), old, new, f"{kind} {name}", f"{kind} {renamed}")
            tally.check(not wrong, f"readable version {number + 1}: {kind} {name} → {renamed}: {wrong}")
    return tally


def _lost(project: Project, old: bytes, new: bytes, owner: str, renamed: str) -> str:
    """What became of an edit of an element's model, if it did not follow; empty if it did."""
    project.save(old)
    project.build()
    path = project.package / replay.models(project.recorded())[owner]
    lines = path.read_text().split("\n")
    lines.insert(len(lines) // 2, MINE)
    path.write_text("\n".join(lines))
    project.save(new)
    result = project.build()
    target = project.package / replay.models(project.recorded()).get(renamed, "")
    followed = target.is_file() and MINE in target.read_text().split("\n")
    if followed and (target == path or not path.exists()) and not result.conflicts:
        return ""
    kinds = {f"{action.kind} {action.path}" for action in result.actions if action.owner in (owner, renamed)}
    return ", ".join(sorted(kinds)) or "nothing was done"


def run(names: Sequence[str], work: Path) -> Tally:
    """Replay, and print a row for each history; gives the sums."""
    total = Tally()
    chosen = {name: all_of for name, all_of in replay.histories().items() if not names or any(n in name for n in names)}
    everything = list(itertools.chain.from_iterable(chosen.values()))
    print("".join(f"{column:>11}" for column in COLUMNS), " history")  # noqa: T201
    for meshes in (False, True):
        for number, (name, versions) in enumerate([*chosen.items(), (LONG, everything)]):
            place = work / f"{number}-{meshes}"
            base = "fixed" if name == LONG else replay.base_of(versions)
            tally = replayed(versions, place, base=base, meshes=meshes)
            if not meshes and name != LONG:
                followed = renames(versions, place, base=base)
                tally.update(followed)
                tally.failures += followed.failures
            _print(tally, f"{name[-50:]}{' + meshes' if meshes else ''}")
            total.update(tally)
    _print(total, "in all")
    return total


def _print(tally: Tally, name: str) -> None:
    print("".join(f"{tally[column]:>11}" for column in COLUMNS), f" {name}", flush=True)  # noqa: T201
    for failure in tally.failures:
        print(f"    {failure[:400]}", flush=True)  # noqa: T201


def main(names: Sequence[str]) -> int:
    """Replay what was asked for; 1 if anything failed."""
    if not replay.histories():
        print("needs the corpus: set URDFSYNC_CORPUS")  # noqa: T201
        return 2
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as work, replay.in_haste():
        total = run(names, Path(work))
    print(f"{time.monotonic() - begin:.0f} s, 0 exceptions")  # noqa: T201 - one would have ended it
    return int(bool(total["failures"]))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
