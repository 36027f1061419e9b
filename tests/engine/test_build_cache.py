"""Whatever was edited, and however: a plan with a memory is the one that a process without one makes."""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest
from support import edits

from urdfsync import config, uptodate
from urdfsync.dependencies import NO_STAT
from urdfsync.diagnostics import UrdfsyncError
from urdfsync.engine.actions import Kind
from urdfsync.engine.build import build
from urdfsync.engine.cache import Cache
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.plan import plan_robot
from urdfsync.engine.stage import Plan

AGE = 0.06
"""Seconds after which a file is old enough to be remembered."""

Edit = Callable[[Path, Random], None]


@pytest.fixture
def memory(project: Path) -> Cache:
    """What a daemon remembers that has built the project a while ago."""
    cache = Cache()
    assert _built(project, cache)
    time.sleep(AGE)
    return cache


def _outputs(project: Path) -> list[Path]:
    return sorted(path for path in (project / "modelica").rglob("*") if path.is_file())


def _other_digit(content: bytes, random: Random) -> bytes:
    """Text of the same length."""
    places = [place for place, byte in enumerate(content) if byte in b"123456789"] or [len(content) - 1]
    place = random.choice(places)
    return content[:place] + (b"2" if content[place : place + 1] == b"1" else b"1") + content[place + 1 :]


def _source(project: Path, random: Random) -> None:
    source = project / "ladder.json"
    source.write_bytes(_other_digit(source.read_bytes(), random))


def _structure(project: Path, random: Random) -> None:
    name, other = ("R2", "R9") if '"R2"' in (text := (project / "ladder.json").read_text()) else ("R9", "R2")
    (project / "ladder.json").write_text(text.replace(f'"{name}"', f'"{other}"'))


def _back_in_time(project: Path, random: Random) -> None:
    _change_back_in_time(random.choice(_outputs(project)), random)


def _change_back_in_time(path: Path, random: Random) -> None:
    """The same size and the same time: only the time of the change of status tells."""
    status = path.stat()
    with path.open("r+b") as file:
        content = _other_digit(file.read(), random)
        file.seek(0)
        file.write(content)
    os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))
    assert path.stat().st_size == status.st_size
    assert path.stat().st_mtime_ns == status.st_mtime_ns


def _replaced(project: Path, random: Random) -> None:
    path = random.choice(_outputs(project))
    path.with_name("new").write_bytes(_other_digit(path.read_bytes(), random))
    shutil.copystat(path, path.with_name("new"))
    path.with_name("new").replace(path)


def _swapped(project: Path, random: Random) -> None:
    one, other = random.sample(_outputs(project), 2)
    spare = one.with_name("spare")
    one.rename(spare)
    other.rename(one)
    spare.rename(other)


def _manifest(project: Path, random: Random) -> None:
    path = random.choice(sorted((project / ".urdfsync/robots").iterdir()))
    path.write_bytes(_other_digit(path.read_bytes(), random))


def _an_older_record(project: Path, random: Random) -> None:
    for path in (project / "first").iterdir():
        shutil.copy(path, project / ".urdfsync/robots" / path.name)


def _bases(project: Path, random: Random) -> None:
    path = project / ".urdfsync/base/ladder/texts"
    lines = path.read_bytes().splitlines(keepends=True)
    random.shuffle(lines)
    path.write_bytes(b"".join(lines[1:])[: -9 if random.random() < 0.5 else None])


def _by_hand(project: Path, random: Random) -> None:
    edits.Hand(random).edit(project / "modelica")


def _nothing(project: Path, random: Random) -> None:
    pass


EDITS: tuple[Edit, ...] = (
    *(_source, _structure, _back_in_time, _back_in_time, _replaced, _swapped, _by_hand, _by_hand, _by_hand),
    *(_manifest, _an_older_record, _bases, _nothing),
)


def _planned(project: Path, memory: Cache | None) -> Plan | tuple[str, ...]:
    loaded = config.load(project / "urdfsync.toml")
    try:
        work = plan_robot(loaded, loaded.robots[0], BuildOptions(cache=memory))
    except UrdfsyncError as error:
        return tuple(map(str, error.diagnostics))
    return work


def _built(project: Path, memory: Cache) -> bool:
    loaded = config.load(project / "urdfsync.toml")
    (result,) = build(loaded, loaded.robots, BuildOptions(cache=memory))
    return not result.failed


def _trusted(memory: Cache) -> list[str]:
    """The files of which the memory believes what the system says."""
    return [path for path, entry in memory.states("ladder").items() if entry and entry[0] != NO_STAT]


def test_a_file_that_was_changed_back_in_time_is_seen(project: Path, memory: Cache) -> None:
    _planned(project, memory)
    for path in _trusted(memory):
        _change_back_in_time(Path(path), Random(0))
        work = _planned(project, memory)
        assert isinstance(work, Plan)
        action = next(action for action in work.actions if path.endswith(action.path))
        assert action.kind is Kind.KEEP


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_any_row_of_edits_is_seen(project: Path, memory: Cache, seed: int) -> None:
    random, safe = Random(seed), project.with_name("safe")
    shutil.copytree(project / ".urdfsync/robots", project / "first")
    for _ in range(30):
        shutil.rmtree(safe, ignore_errors=True)
        shutil.copytree(project, safe)
        time.sleep(AGE)
        _planned(project, memory)
        edit = random.choice(EDITS)
        edit(project, random)
        with_memory, without = _planned(project, memory), _planned(project, None)
        assert with_memory == without, edit.__name__
        if isinstance(without, tuple) or (random.random() < 0.7 and not _built(project, memory)):
            shutil.rmtree(project)  # nothing can be built of it
            shutil.copytree(safe, project)
            os.chdir(project)


def test_a_file_that_was_just_written_is_read_again(
    project: Path, memory: Cache, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Within one tick of the clock a file can change without any difference in what the system says of it."""
    with monkeypatch.context() as patch:
        patch.setattr(uptodate, "_TICK", 60_000_000_000)
        _planned(project, memory)
        assert not _trusted(memory)
    _planned(project, memory)
    assert set(map(Path, _trusted(memory))) <= set(_outputs(project))
    assert len(_trusted(memory)) > 5
    just = Path(_trusted(memory)[0])
    just.write_bytes(just.read_bytes() + b"// mine\n")
    monkeypatch.setattr(uptodate, "_TICK", 60_000_000_000)
    _planned(project, memory)
    assert str(just) not in _trusted(memory)


@pytest.mark.parametrize("why", ["on Windows", "a clock that can be set", "no place for a file"])
def test_nothing_is_remembered_where_nobody_knows_when_a_file_changed(
    project: Path, memory: Cache, why: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    if why == "on Windows":
        monkeypatch.setattr(uptodate, "HAS_CHANGE_TIMES", False)
    elif why == "a clock that can be set":
        clock = uptodate.Clock(project.stat(), is_reliable=False)
        monkeypatch.setattr(uptodate, "read_clock", lambda folder: clock)
    else:
        (project / ".urdfsync/.clock.urdfsync-tmp").mkdir()
    _planned(project, memory)
    assert not _trusted(memory)


def test_a_full_build_reads_every_file(project: Path, memory: Cache) -> None:
    _planned(project, memory)
    seen = {
        path: entry and entry._replace(sha256="wrong", text_sha256="wrong")
        for path, entry in memory.states("ladder").items()
    }
    memory.note_states("ladder", seen, uptodate.read_clocks(), lambda: uptodate.read_clock(project / ".urdfsync"))
    assert len(_trusted(memory)) > 5
    loaded = config.load(project / "urdfsync.toml")
    work = plan_robot(loaded, loaded.robots[0], BuildOptions(cache=memory, full=True, dry=True))
    assert not any(action.writes for action in work.actions)
    assert not any(entry and "wrong" in entry for entry in memory.states("ladder").values())
