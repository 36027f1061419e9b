"""Results in a folder that several machines share: read with the team's secret only; a forged result is no verdict."""

from __future__ import annotations

import pickle
import shutil
import threading
from collections.abc import Callable
from pathlib import Path

import msgspec
import pytest
from support.checks import Compiling

from urdfsync import config
from urdfsync.checks import remote
from urdfsync.checks.results import CheckOptions, CheckResult, CheckStatus
from urdfsync.checks.robot import check_robot

SECRET = "a secret of one team"


@pytest.fixture(autouse=True)
def team(monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> None:
    """The machines of a team; a process has not met a bad remote cache yet."""
    monkeypatch.setenv(remote.SECRET, SECRET)
    monkeypatch.setattr(remote, "_problems", {})
    if "arm" in request.fixturenames:
        request.getfixturevalue("modelica_library")  # without it, nothing is compiled
        request.getfixturevalue("compiler")
        # no test changes a library; hashing takes seconds
        monkeypatch.setattr("urdfsync.checks.contents.content_hash", lambda *_: "")


@pytest.fixture
def shared(tmp_path: Path) -> Path:
    return tmp_path / "shared"


def check(address: object, *, writes: bool = False) -> CheckResult:
    loaded = config.load(Path("urdfsync.toml").absolute())
    return check_robot(loaded, loaded.robots[0], CheckOptions(remote_cache=str(address), remote_write=writes))


def forget(tmp_path: Path) -> None:
    """Go to a machine whose own cache is empty."""
    shutil.rmtree(tmp_path / "cache", ignore_errors=True)


def warnings(result: CheckResult) -> list[str]:
    return [finding.message for finding in result.diagnostics if finding.code == remote.CODE]


def test_a_second_machine_compiles_nothing(arm: Path, compiler: Compiling, shared: Path, tmp_path: Path) -> None:
    first = check(shared, writes=True)
    compiler.models.clear()
    forget(tmp_path)
    second = check(shared)
    assert (second.status, second.compiled, compiler.models) == (first.status, first.compiled, [])
    assert warnings(first) == warnings(second) == []


def test_nothing_is_written_unless_asked(arm: Path, shared: Path) -> None:
    assert warnings(check(shared)) == []
    assert not shared.exists()


FORGERIES: dict[str, Callable[[bytes], bytes]] = {
    "another verdict": lambda content: content[:32] + msgspec.msgpack.encode(CheckResult("arm", "Arm")),
    "a flipped bit": lambda content: content[:-1] + bytes([content[-1] ^ 1]),
    "truncated": lambda content: content[:40],
    "no signature": lambda content: content[32:],
    "a pickle": lambda _: pickle.dumps(print),
    "one byte": lambda _: b"x",
    "huge": lambda _: b"x" * (16 * 2**20 + 1),
}


@pytest.mark.parametrize("forge", FORGERIES.values(), ids=FORGERIES)
def test_a_forged_result_changes_no_verdict(
    forge: Callable[[bytes], bytes], arm: Path, compiler: Compiling, shared: Path, tmp_path: Path
) -> None:
    check(shared, writes=True)
    (file,) = shared.iterdir()
    file.write_bytes(forge(file.read_bytes()))
    forget(tmp_path)
    compiler.problem = "it does not compile"
    result = check(shared)
    assert result.status is CheckStatus.FAILED
    assert "was refused" in "".join(warnings(result))


@pytest.mark.slow
def test_a_result_under_the_name_of_another_package_is_refused(
    arm: Path, compiler: Compiling, shared: Path, tmp_path: Path
) -> None:
    check(shared, writes=True)
    (right,) = shared.iterdir()
    (arm / "Own.mo").write_text("within Arm;\nmodel Own\n  Real x;\nend Own;\n")
    check(shared, writes=True)
    (other,) = set(shared.iterdir()) - {right}
    shutil.copyfile(right, other)
    forget(tmp_path)
    compiler.problem = "it does not compile"
    result = check(shared)
    assert result.status is CheckStatus.FAILED
    assert "signature" in "".join(warnings(result))


@pytest.mark.parametrize("secret", ["", "short", "another secret, of strangers"])
def test_without_the_secret_results_are_local(
    secret: str, arm: Path, compiler: Compiling, shared: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    check(shared, writes=True)
    forget(tmp_path)
    compiler.models.clear()
    monkeypatch.setenv(remote.SECRET, secret)
    result = check(shared)
    assert compiler.models
    assert len(warnings(result)) == 1


@pytest.mark.parametrize("address", ["nowhere://bucket", "/dev/null/folder"])
def test_a_remote_that_is_absent_is_a_warning(address: str, arm: Path, compiler: Compiling) -> None:
    result = check(address, writes=True)
    assert compiler.models
    assert len(warnings(result)) == 1


def test_a_slow_remote_is_asked_once(
    arm: Path, compiler: Compiling, shared: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked, end = list[str](), threading.Event()

    def read(system: object, path: str) -> bytes:
        asked.append(path)
        end.wait()
        return b""

    monkeypatch.setattr(remote, "_read", read)
    monkeypatch.setattr(remote, "PATIENCE", 0.01)
    try:
        assert "no answer" in "".join(warnings(check(shared, writes=True)))
        assert not shared.exists()
    finally:
        end.set()
    assert len(asked) == 1
