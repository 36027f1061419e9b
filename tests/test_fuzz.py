"""The command `tests/fuzz.py`: it finds what is planted, repeats it by its seed, and a few cases of each kind pass."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from random import Random

import pytest
from fuzzing import cases, urdf
from support.workplace import Fault

FUZZ = Path(__file__).with_name("fuzz.py")
PATIENCE = 300.0

pytestmark = [pytest.mark.slow, pytest.mark.skipif(sys.platform == "win32", reason="no such signals and FIFOs")]


@pytest.mark.parametrize(("kind", "count"), [("config", 100), ("state", 100)])
def test_no_case_of_many_shows_a_fault(kind: str, count: int) -> None:
    command = [sys.executable, str(FUZZ), kind, str(count), "--seed", "5000"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=4 * PATIENCE, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_each_fault_is_told_with_its_seed_and_its_input_comes_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    given: dict[int, bytes] = {}

    def case(random: Random) -> str:
        content = urdf.damaged(urdf.small_robot(random).encode(), random)
        given[len(given)] = content
        if len(given) == 2:
            raise Fault("a file is lost")
        if len(given) == 3:
            raise ValueError("no number")
        return "fine"

    assert cases.run_cases("config", case, 4, 10) == 2
    told = capsys.readouterr().out
    assert "config, seed 11: a file is lost\n" in told
    assert "config, seed 12: ValueError" in told
    assert "2 fine; 2 faults" in told
    assert Path(cases.LAST_SEED).read_text() == "13\n"
    cases.run_cases("config", case, 1, 12)
    assert given[4] == given[2]


def test_what_computes_without_end_is_a_fault(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(cases, "CPU_LIMIT", 0.1)

    def case(_random: Random) -> str:
        while True:
            pass

    assert cases.run_cases("config", case, 1, 1) == 1
    assert "more than 0.1 s of computing" in capsys.readouterr().out


def test_a_case_that_ends_the_process_is_told_and_the_next_ones_run(tmp_path: Path) -> None:
    """The kind is a module of its own here, which the command finds in its folder."""
    folder = tmp_path / "tests"
    (folder / "fuzzing").mkdir(parents=True)
    (folder / "fuzz.py").write_text(FUZZ.read_text())
    (folder / "fuzzing/config.py").write_text(
        "import os\n\n\n"
        "def run(count, seed):\n"
        "    for number in range(seed, seed + count):\n"
        "        open('last-seed', 'w').write(str(number))\n"
        "        print('ran', number, flush=True)\n"
        "        if number == 2:\n"
        "            os.kill(os.getpid(), 9)\n"
        "    return 0\n"
    )
    command = [sys.executable, str(folder / "fuzz.py"), "config", "4"]
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=False)
    assert done.returncode == 1
    assert done.stdout.splitlines() == ["ran 1", "ran 2", "config, seed 2: the process ended with -9", "ran 3", "ran 4"]
