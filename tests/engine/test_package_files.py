"""Files of a package: the daemon reads those again that have changed."""

from __future__ import annotations

import os
import time
from pathlib import Path

import pytest
from support.networks import LADDER, run

from urdfsync import config, dependencies
from urdfsync.engine.package_files import PackageFiles
from urdfsync.files import digest

FILE = f"{LADDER}/Ladder.mo"


def files() -> PackageFiles:
    """The files of the only robot, as another build sees them."""
    loaded = config.load(Path("urdfsync.toml"))
    return PackageFiles(loaded, loaded.robots[0])


@pytest.fixture
def old(project: Path, monkeypatch: pytest.MonkeyPatch) -> bytes:
    """The content of a file that was read when it was no longer young."""
    run()
    monkeypatch.setattr(dependencies, "YOUNG", -(10**12))
    assert files().state(FILE)
    return Path(FILE).read_bytes()


def test_a_file_is_read_again_once_its_stat_values_differ(old: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patched:
        patched.setattr("urdfsync.files.read_unrecorded", lambda path: b"not read again")
        state = files().state(FILE)
    assert state is not None
    assert state.sha256 == digest(old)
    status = Path(FILE).stat()
    time.sleep(0.02)
    Path(FILE).write_bytes(old[::-1])
    os.utime(FILE, ns=(status.st_atime_ns, status.st_mtime_ns))
    state = files().state(FILE)
    assert state is not None
    assert state.sha256 == digest(old[::-1])


def test_a_file_that_is_gone_or_a_folder_is_not_what_it_was(old: bytes) -> None:
    Path(FILE).rename("elsewhere.mo")
    assert files().state(FILE) is None
    Path("elsewhere.mo").rename(FILE)
    folder = Path(LADDER)
    folder.rename("elsewhere")
    folder.symlink_to(Path("elsewhere").resolve())
    with pytest.raises(Exception, match="a symbolic link is where"):
        files().state(FILE)


def test_a_file_that_was_just_written_is_read_each_time(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run()
    assert files().state(FILE)
    monkeypatch.setattr("urdfsync.files.read_unrecorded", lambda path: b"read again")
    state = files().state(FILE)
    assert state is not None
    assert state.sha256 == digest(b"read again")
