"""Functions in a process of their own: results, limits, and what is said of one that ends early."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import psutil
import pytest
from support import checks
from support.checks import act

from urdfsync.analysis.checks import process
from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.compilers import COMPILERS, run_job
from urdfsync.analysis.checks.compilers.compiler import CompileJob, CompilerError, CompileTask, Tool
from urdfsync.analysis.checks.process import BrokenProcessError, LimitError, Limits, run
from urdfsync.common.diagnostics import OutputError

TESTS = Path(__file__).parents[2]


@pytest.fixture(autouse=True)
def _path(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PYTHONPATH", str(TESTS))


def limits(seconds: float = 60.0, memory: float = 2e9) -> Limits:
    return Limits("the check", seconds, memory)


def test_all_that_a_function_yields_comes_back_and_prints_are_no_answers() -> None:
    assert run(act, "one", "print", "two", limits=limits()) == ["one", "print", "two"]
    assert run(act, limits=limits()) == []


@pytest.mark.parametrize(("deed", "kind", "words"), [
    ("refuse", OutputError, "as it was asked for"),
    ("import", ImportError, "no such wheel"),
    ("leave", BrokenProcessError, "exit code 0"),
    pytest.param("abort", BrokenProcessError, r"\(SIGABRT\): last words",
                 marks=pytest.mark.skipif(sys.platform == "win32", reason="no such signals")),
    pytest.param("profile", LimitError, "takes more than 60 s of processor time",
                 marks=pytest.mark.skipif(sys.platform == "win32", reason="no such signals")),
])  # fmt: skip
def test_an_error_and_an_end_before_the_end_are_told(deed: str, kind: type[Exception], words: str) -> None:
    with pytest.raises(kind, match=words) as caught:
        run(act, "one", deed, "two", limits=limits())
    assert not isinstance(caught.value, BrokenProcessError) or caught.value.results == ["one"]


def test_progress_is_told_until_the_end() -> None:
    told: list[int] = []
    assert run(act, "one", limits=limits(), progress=lambda: told.append(1)) == ["one"]
    assert told


@pytest.mark.slow
def test_what_a_process_has_started_ends_with_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    looks: list[list[psutil.Process]] = []
    others = psutil.Process().children(recursive=True)  # workers of earlier tests

    def progress() -> None:
        if Path("started").exists():
            children = psutil.Process().children(recursive=True)
            looks.append([child for child in children if child not in others])
        if len(looks) == 2:  # the process was looked at in between
            Path("seen").touch()

    assert run(act, "start", limits=limits(600), progress=progress) == ["start"]
    _, alive = psutil.wait_procs(looks[0], timeout=60)
    assert [child for child in alive if child.status() != psutil.STATUS_ZOMBIE] == []
    assert len(looks[0]) == 2


def test_native_code_finds_an_empty_stdin_while_a_thread_waits_for_the_parent() -> None:
    """Windows lets nobody ask a pipe for its kind while somebody reads it, as libraries do while they are loaded."""
    assert run(act, "stdin", limits=limits()) == ["empty", "stdin"]


@pytest.mark.skipif(sys.platform == "win32", reason="no such groups")
def test_a_process_keeps_the_session_and_so_the_priority_but_gets_no_interruption() -> None:
    assert run(act, "session", limits=limits())[0] == f"{os.getsid(0)} True"


@pytest.mark.slow
@pytest.mark.parametrize("deed", ["work", "sleep"])
def test_only_processor_time_counts_unless_a_process_does_nothing(deed: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(process, "_MOST_IDLE", 1.5 if deed == "sleep" else 60)
    allowed = limits(0.5 if deed == "work" else 60)
    with pytest.raises(LimitError) as caught:
        run(act, deed, limits=allowed)
    (found,) = caught.value.diagnostics
    words = {"work": "takes more than 0.5 s of processor time", "sleep": "does nothing: a process has waited for 1.5 s"}
    assert found.message == f"the check {words[deed]}"
    assert "--tool" in found.hint
    assert (allowed.used >= 0.5) == (deed == "work")


@pytest.mark.skipif(sys.platform == "win32", reason="no such signals")
@pytest.mark.parametrize(("deed", "code", "words", "hint"), [
    ("abort", "compiler-crashed", r"crashed at Plant.Bad: signal 6 (SIGABRT): last words", "report the crash"),
    ("kill", "compiler-crashed", "crashed at Plant.Bad: signal 9 (SIGKILL)", "out of memory"),
    ("leave", "compiler-crashed", "crashed at Plant.Bad: exit code 0", "report the crash"),
    ("import", "no-compiler", "the compiler does not start: no such wheel", "install it"),
])  # fmt: skip
def test_a_compiler_that_breaks_down_is_one_line(
    deed: str, code: str, words: str, hint: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(COMPILERS, "fake", checks.Compiler())
    tasks = CompileTask("M", "", title="Plant.Good"), CompileTask("M", deed, title="Plant.Bad")
    with pytest.raises(CompilerError) as caught:
        run_job(Tool("fake"), CompileJob((), tasks), UserCache(tmp_path), limits())
    (found,) = caught.value.diagnostics
    assert found.code == code
    assert words in found.message
    assert hint in found.hint
