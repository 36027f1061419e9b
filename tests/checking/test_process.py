"""Child processes under limits: real ones, small Python programs."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import psutil
import pytest

from urdfsync.checking import process
from urdfsync.checking.process import Ending, Limits, Result

GENEROUS = 60.0  # s
LINUX = sys.platform == "linux"
ONLY = "elsewhere such a process goes on until it is done"

SLEEP = "import time; time.sleep(600)"
GRANDCHILD = f"""
import subprocess, sys, time
print(subprocess.Popen([sys.executable, "-c", "{SLEEP}"]).pid, flush=True)
"""


def run(program: str, text: str = "", limits: Limits = process.UNLIMITED) -> tuple[Result, list[str]]:
    """The program's end and its lines."""
    lines: list[str] = []
    return process.run([sys.executable, "-c", program], text, lines.append, limits), lines


def wait_for(condition: Callable[[], bool]) -> None:
    end = time.monotonic() + GENEROUS
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.01)


def is_gone(pid: int) -> bool:
    try:
        return psutil.Process(pid).status() == psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return True


def test_a_child_reads_its_text_and_is_heard_line_by_line() -> None:
    result, lines = run("print(input()[::-1]); print('ü'); print('no end', end='')", "abc\n")
    assert lines == ["cba", "ü", "no end"]
    assert result.good
    assert result.ending is Ending.EXITED


def test_a_line_is_told_while_the_child_works() -> None:
    lines: list[str] = []

    def tick() -> None:
        if lines:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        process.run([sys.executable, "-c", f"print('first', flush=True); {SLEEP}"], "", lines.append, tick=tick)
    assert lines == ["first"]


def test_stdin_stays_open_as_long_as_the_child_runs() -> None:
    program = "import select, sys; print(bool(select.select([sys.stdin], [], [], 0.2)[0]))"
    _, lines = run(program)
    assert lines == ["False"], "nothing to read, and not its end either"


@pytest.mark.parametrize("size", [0, 2_000_000])
def test_long_texts_do_not_stick_in_pipes(size: int) -> None:
    program = "import sys; text = sys.stdin.readline(); sys.stderr.write(text); print(text, end=''); print(len(text))"
    result, lines = run(program, "x" * size + "\n")
    assert [len(line) for line in lines[:-1]] == [size]
    assert lines[-1] == str(size + 1)
    assert len(result.words) <= process.WORDS


def test_a_child_that_does_not_read_its_text_is_no_trouble() -> None:
    result, _ = run("", "x" * 2_000_000)
    assert result.good


def test_the_last_words_are_kept() -> None:
    result, _ = run("import sys; sys.stderr.write('x' * 1_000_000 + 'the end'); sys.exit(3)")
    assert (result.ending, result.code, result.cause) == (Ending.EXITED, 3, "exit code 3")
    assert result.words.endswith("xthe end")
    assert len(result.words) == process.WORDS
    assert not result.good


@pytest.mark.skipif(sys.platform == "win32", reason="no such signals")
def test_a_crash_has_the_name_of_its_signal() -> None:
    program = (
        "import os, signal; print('whole'); print('torn', end='', flush=True); os.kill(os.getpid(), signal.SIGSEGV)"
    )
    result, lines = run(program)
    assert (result.ending, result.cause) == (Ending.CRASHED, "signal 11 (SIGSEGV)")
    assert lines == ["whole"], "a line that was torn off is none"


def test_a_child_that_takes_too_long_is_ended() -> None:
    seconds = 2.0  # long enough for a busy machine to begin
    result, lines = run(f"print('begun', flush=True); {SLEEP}", limits=Limits(seconds=seconds))
    assert result.ending is Ending.OUT_OF_TIME
    assert not result.good
    assert lines == ["begun"]
    assert result.seconds >= seconds


def test_a_child_that_closes_stdout_is_followed_all_the_same() -> None:
    result, _ = run(f"import os; os.close(1); {SLEEP}", limits=Limits(seconds=0.5))
    assert result.ending is Ending.OUT_OF_TIME


@pytest.mark.parametrize("who", ["child", "grandchild"])
def test_memory_counts_for_the_whole_family(who: str) -> None:
    greedy = f"x = bytearray(b'x') * 300_000_000; {SLEEP}"
    program = (
        greedy if who == "child" else f"import subprocess, sys; subprocess.run([sys.executable, '-c', {greedy!r}])"
    )
    result, _ = run(program, limits=Limits(GENEROUS, 200e6))
    assert result.ending is Ending.OUT_OF_MEMORY
    assert result.memory > 200e6


def test_the_greatest_memory_is_reported() -> None:
    result, _ = run("x = bytearray(b'x') * 100_000_000; import time; time.sleep(0.5)")
    assert result.good
    assert 100e6 < result.memory < 200e6


def test_grandchildren_do_not_outlive_a_child() -> None:
    result, (pid,) = run(GRANDCHILD)
    assert result.good
    wait_for(lambda: is_gone(int(pid)))


@pytest.mark.parametrize("exception", [KeyboardInterrupt, ValueError])
def test_an_exception_leaves_nobody_behind(exception: type[BaseException]) -> None:
    pids: list[int] = []

    def hear(line: str) -> None:
        pids.append(int(line))
        raise exception

    with pytest.raises(exception):
        process.run([sys.executable, "-c", GRANDCHILD + SLEEP], "", hear)
    wait_for(lambda: is_gone(pids[0]))


def test_what_the_caller_raises_now_and_then_gives_the_child_up() -> None:
    def tick() -> None:
        raise TimeoutError

    before = psutil.Process().children()  # what starts processes for other tests stays
    with pytest.raises(TimeoutError):
        process.run([sys.executable, "-c", SLEEP], tick=tick)
    now = [child for child in psutil.Process().children() if child.status() != psutil.STATUS_ZOMBIE]
    assert [child for child in now if child not in before] == []


def test_a_program_that_is_not_there_is_an_error_of_the_system(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        process.run([str(tmp_path / "absent")])


def test_many_children_at_once() -> None:
    with ThreadPoolExecutor(8) as pool:
        found = list(pool.map(lambda number: run("print(input())", f"{number}\n"), range(8)))
    assert [lines for _, lines in found] == [[str(number)] for number in range(8)]
    assert all(result.good for result, _ in found)


def test_the_environment_is_added_to() -> None:
    lines: list[str] = []
    program = "import os; print(os.environ['ADDED'], 'PATH' in os.environ)"
    process.run([sys.executable, "-c", program], "", lines.append, environment={"ADDED": "yes"})
    assert lines == ["yes True"]


@pytest.mark.parametrize(
    "program",
    [
        SLEEP,
        pytest.param("sys.setswitchinterval(1e6)\nwhile True: pass", marks=pytest.mark.skipif(not LINUX, reason=ONLY)),
    ],
    ids=["that waits", "that lets no other thread run"],
)
def test_a_process_ends_with_its_parent(program: str) -> None:
    begin = "import sys; from urdfsync.checking.process import end_with_parent as e; e(); print('ready', flush=True)\n"
    command = [sys.executable, "-c", begin + program]
    environment = os.environ | process.importable()
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdin=pipe, stdout=pipe, env=environment) as child:
        assert child.stdin is not None
        assert child.stdout is not None
        assert child.stdout.readline() == b"ready\n"
        assert child.poll() is None
        child.stdin.close()  # as the system does it with the files of a process that is killed
        assert child.wait(GENEROUS) in (1, -signal.SIGIO if LINUX else 1)


def test_modules_are_found_whatever_the_working_folder_holds(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "msgspec.py").write_text("raise SystemExit(9)\n")
    monkeypatch.chdir(tmp_path)
    result = process.run(process.python("urdfsync"), environment=process.importable() | {"COLUMNS": "80"})
    assert result.code != 9
    assert "usage" in result.words
