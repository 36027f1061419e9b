"""What was read is recorded; the record is incomplete if something changed meanwhile, or was rendered or written."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest
from support import xacros
from support.networks import RECORD, configure, resistor, run, run_all

from urdfsync.answers import dependencies
from urdfsync.answers.facts import LSTAT, MODELICA, NAMES, NOTHING, STAT, STAT_TYPE, VARIABLE, check_path
from urdfsync.files import digest


@pytest.fixture
def folder(in_step: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    shutil.copytree(in_step, tmp_path / "project")
    monkeypatch.chdir(tmp_path / "project")
    run_all()  # the first one in a copy notes that it wrote this folder
    return tmp_path / "project"


@pytest.mark.parametrize("options", [{"full": True}, {"jobs": 1}, {"jobs": 2}], ids=str)
def test_a_build_that_renders_or_writes_is_incomplete(folder: Path, options: dict[str, Any]) -> None:
    if "jobs" in options:
        (folder / "modelica/Leg/Leg.mo").unlink()
    with dependencies.Dependencies() as found:
        assert not any(result.failed for result in run_all(**options))
    assert not found.complete


def test_environment_variables_are_recorded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("LENGTH", raising=False)
    for value in (None, "", "0.5", "0.6"):
        if value is not None:
            monkeypatch.setenv("LENGTH", value)
        before = check_path(VARIABLE, "LENGTH")
        with dependencies.Dependencies() as found:
            assert dependencies.read_variable("LENGTH") == value
        assert found.entries == {(VARIABLE, "LENGTH"): before}
        monkeypatch.setenv("LENGTH", "another")
        assert check_path(VARIABLE, "LENGTH") != before


def test_what_changes_or_fails_meanwhile_makes_the_record_incomplete(tmp_path: Path) -> None:
    file = tmp_path / "file"
    with dependencies.Dependencies() as found:
        assert not dependencies.is_file(file)
        file.write_text("a")
        assert dependencies.is_file(file)
    assert not found.complete, "it came meanwhile"
    with dependencies.Dependencies() as found:
        assert dependencies.read_file(file) == b"a"
        assert found.complete
        file.write_text("ab")
        assert dependencies.read_file(file) == b"ab"
    assert not found.complete, "it changed meanwhile"
    with dependencies.Dependencies() as found, pytest.raises(OSError, match="too long"):
        dependencies.is_file(tmp_path / ("a" * 5000))
    assert not found.complete, "the system did not tell"


def test_a_plan_lists_what_it_has_read_each_with_its_kind(project: Path) -> None:
    """Files, places where nothing is, names in folders, and outputs that are to be made."""
    configure('package_paths = ["later"]\ntemplates = "own"\n')
    (project / "own").mkdir()
    (project / "Mine.mo").write_text("model Mine end Mine;")
    (project / "step.csv").unlink()
    reads = run(dry=True).reads.entries
    for check, name in ((STAT, "ladder.json"), (STAT, "Mine.mo"), (NAMES, "own"), (MODELICA, ".")):
        assert reads[check, str((project / name).resolve())] != NOTHING
    for check, name in ((STAT_TYPE, "step.csv"), (STAT_TYPE, "later/step.csv"), (STAT_TYPE, "modelica")):
        assert reads[check, str(project / name)] == NOTHING
    run()
    assert (LSTAT, str(project / RECORD)) in run(dry=True).reads.entries


def test_an_error_carries_the_list_in_the_place_of_a_plan(project: Path) -> None:
    (project / "ladder.json").unlink()
    (failed,) = run_all()
    assert failed.reads.entries[STAT_TYPE, str(project / "ladder.json")] == NOTHING
    (project / "ladder.json").write_text("{")
    (failed,) = run_all()
    assert failed.reads.entries[STAT, str(project / "ladder.json")] != NOTHING


def test_so_does_an_error_of_xacro(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    source = xacros.ARM.replace("parts/beam.xacro", "parts/*.xacro").replace("masses.yaml", "gone.yaml")
    xacros.write(tmp_path, {"arm.urdf.xacro": source})
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "urdf/arm.urdf.xacro"\npackage = "Arm"\n')
    (failed,) = run_all()
    assert failed.failed
    reads = {
        (check, str(Path(path).relative_to(tmp_path))): facts
        for (check, path), facts in failed.reads.entries.items()
        if path.startswith(str(tmp_path))
    }
    assert reads[STAT, "urdf/gone.yaml"] == NOTHING
    assert (NAMES, "urdf/parts") in reads


def test_a_build_lists_what_it_wrote_as_it_is_then(project: Path) -> None:
    run()
    resistor(150)
    result = run()
    assert result.writes
    for entry, facts in result.reads.entries.items():
        assert check_path(*entry) == facts, entry
    record = project / RECORD
    assert result.reads.hashes[LSTAT, str(record)] == digest(record.read_bytes())
