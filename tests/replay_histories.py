"""Replays the histories of the corpus: builds each version over the one before, and compares with a fresh build.

`python tests/replay_histories.py [NAME …]` prints a row for each history whose name contains a NAME (all without
any), without meshes and with made-up ones, then all of them as one long history of one robot. The exit code is 1 if
anything is not as it should be. `tests/test_replay.py` runs a part of it.
"""

from __future__ import annotations

import itertools
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

from support import replay
from support.replay import Built, Fresh, Project, Stamps

from urdfsync.domain import ChangeClass
from urdfsync.outcome import Result
from urdfsync.urdf.domain import DOMAIN

COLUMNS = ("versions", "refused", *map(str, ChangeClass), "unwritten", "renames")
MINE = "  // mine: has to follow its element"
LONG = "all of them, one after the other"
REACH = {ChangeClass.NONE: set(), ChangeClass.UNMODELLED: set(), ChangeClass.PARAMETER: {"record", "import"}}
"""Roles of the files that a step of a class may write."""
BELOW = f"{replay.PACKAGE}/"

Replayed = tuple[Counter[str], list[str]]
"""What was counted, and what was wrong."""


def replayed(versions: Sequence[bytes], work: Path, *, base: str, meshes: bool) -> Replayed:
    """Build the versions one over the other."""
    tally, faults, built = Counter[str](), list[str](), Built({}, {})
    project, fresh = Project(work / "project", base, meshes=meshes), Fresh(work / "fresh", base, meshes=meshes)
    for number, content in enumerate(versions):
        before = project.stamps()
        project.save(content)
        result = project.build()
        after = project.stamps()
        faults += [f"version {number}: {one}" for one in _faults(project, before, result, built, fresh(content))]
        tally["versions"] += 1
        tally["refused"] += result.failed
        if not result.failed and built.files:
            tally[str(_class_of(result))] += 1
            tally["unwritten"] += sum(before.get(path) == stamp for path, stamp in after.items() if BELOW in path)
        built = built if result.failed else fresh(content)
    return tally, faults


def _faults(project: Project, before: Stamps, result: Result, old: Built, new: Built) -> Iterator[str]:
    """What is not as it should be after a build of the version whose fresh build is `new`, over that of `old`."""
    after = project.stamps()
    touched = {path for path in before.keys() | after.keys() if before.get(path) != after.get(path)}
    touched = {path for path in touched if path.startswith((".urdfsync/", BELOW))}
    if result.failed or not new.files:
        yield from ["a version is built here or fresh, and refused there"] if new.files or not result.failed else []
        yield from (f"{path} changed in spite of an error" for path in touched - {".urdfsync/.gitignore"})
        return
    files, state = project.files(), project.state()
    both = files.keys() | new.files.keys()
    yield from (f"{path} differs from a fresh build" for path in both if files.get(path) != new.files.get(path))
    yield from (f"{path} differs from that of a fresh build" for path in state if state[path] != new.state.get(path))
    written = {path.removeprefix(BELOW) for path in touched if path.startswith(BELOW)}
    yield from (f"{path} is written with its own bytes" for path in written if old.files.get(path) == files.get(path))
    if old.files and (allowed := REACH.get(_class_of(result))) is not None:
        roles = {action.path.removeprefix(BELOW): str(action.role) for action in result.actions}
        yield from (f"a {_class_of(result)} step writes {path}" for path in written if roles[path] not in allowed)
    project.build()
    yield from ["a second build writes"] if project.stamps() != after else []


def _class_of(result: Result) -> ChangeClass:
    return result.changes.change_class if result.changes else ChangeClass.NONE


def renames(versions: Sequence[bytes], work: Path, *, base: str) -> Replayed:
    """Edit each element that a step only renames, and see whether the edit is in the renamed element's model then."""
    tally, faults = Counter[str](), []
    readable = [(content, found) for content in versions if (found := replay.snapshot_of(content)) is not None]
    for (old, before), (new, after) in itertools.pairwise(readable):
        for (kind, name), renamed in DOMAIN.renames(before, after).items():
            tally["renames"] += 1
            project = Project(work / f"rename-{tally['renames']}", base)
            if fault := _lost(project, old, new, f"{kind} {name}", f"{kind} {renamed}"):
                faults.append(f"{kind} {name} → {renamed}: {fault}")
    return tally, faults


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


def main(names: Sequence[str]) -> int:
    """Replay what was asked for, and print a row for each history; 1 if anything failed."""
    chosen = {name: all_of for name, all_of in replay.histories().items() if not names or any(n in name for n in names)}
    if not chosen:
        print("needs the corpus: set URDFSYNC_CORPUS")  # noqa: T201
        return 2
    everything = [*chosen.items(), (LONG, list(itertools.chain.from_iterable(chosen.values())))]
    wrong = 0
    print("".join(f"{column:>11}" for column in (*COLUMNS, "faults")), " history")  # noqa: T201
    for (name, versions), meshes in itertools.product(everything, (False, True)):
        with tempfile.TemporaryDirectory() as work, replay.in_haste():
            base = "fixed" if name == LONG else replay.base_of(versions)
            tally, faults = replayed(versions, Path(work), base=base, meshes=meshes)
            if not meshes and name != LONG:
                followed, lost = renames(versions, Path(work), base=base)
                tally, faults = tally + followed, faults + lost
        cells = "".join(f"{number:>11}" for number in (*(tally[column] for column in COLUMNS), len(faults)))
        print(cells, f" {name[-50:]}{' + meshes' if meshes else ''}", flush=True)  # noqa: T201
        for fault in faults:
            print(f"    {fault[:400]}", flush=True)  # noqa: T201
        wrong += len(faults)
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
