"""FMUs: what is exported, with which tolerance and names, and which files are ours."""

from __future__ import annotations

import io
import os
import sys
import tempfile
import tracemalloc
import zipfile
from pathlib import Path

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.fmu import BOTH, OPTIONS, archive, exported
from support.simulation import Compiler

from urdfsync.analysis.checks.compilers.compiler import CompileResult, Export
from urdfsync.analysis.simulation.export import export, is_exported
from urdfsync.common.diagnostics import UrdfsyncError
from urdfsync.project import config


def test_run_is_exported_as_a_model_of_its_own_with_the_tolerance_inside(openmodelica: Compiler) -> None:
    values = ("robot.elbow.parameters.dynamics.damping=4",)
    found = exported(msgspec.structs.replace(OPTIONS, values=values, tolerance=1e-9))
    assert (found.model, found.name, found.tolerance) == ("Arm.ArmRun", "Arm_ArmRun", 1e-9)
    (task,) = openmodelica.jobs[0].tasks
    assert task.export == BOTH
    assert "extends Arm.ArmRun(robot(elbow(parameters(dynamics(damping = 4)))));" in task.source
    assert "Tolerance = 1e-09" in task.source
    assert found.tool == "OpenModelica 1.27.0"


def test_higher_derivatives_get_the_names_that_fmi_has_for_them(openmodelica: Compiler) -> None:
    with zipfile.ZipFile(io.BytesIO(exported().content)) as file:
        text = file.read("modelDescription.xml").decode()
        assert file.read("binaries/linux64/Arm_ArmRun.so") == b"code"
    assert 'name="der(robot.elbow.phi,3)"' in text
    assert 'name="der(robot.elbow.phi)"' in text
    assert "<ModelExchange" in text


def test_co_simulation_alone_is_cut_out_of_both(openmodelica: Compiler) -> None:
    """Since OpenModelica reduces the index in another way then, which fails with floating bases."""
    loaded = config.load(Path("urdfsync.toml").absolute())
    found = export(loaded, loaded.robots[0], OPTIONS, Export("2.0", "cs"), lambda *_: None)
    assert openmodelica.jobs[0].tasks[0].export == BOTH
    with zipfile.ZipFile(io.BytesIO(found.content)) as file:
        text = file.read("modelDescription.xml").decode()
    assert "<ModelExchange" not in text
    assert '<CoSimulation modelIdentifier="Arm_ArmRun"/>' in text


def test_a_model_that_can_not_be_exported_is_told_with_what_the_compiler_says(openmodelica: Compiler) -> None:
    openmodelica.results = [CompileResult("Error: no C compiler was found: install clang.")]
    with pytest.raises(UrdfsyncError, match="no C compiler was found: install clang"):
        exported()


def test_a_stranger_s_file_at_the_default_name_is_read_within_limits(tmp_path: Path) -> None:
    """A bomb of 5 MB may have a description of 5 GB; the first 64 KB of it tell."""
    file, words = tmp_path / "ArmRun.fmu", b'<a description="Arm.ArmRun, exported by urdfsync 1.0.0">'
    for compression, is_ours in ((zipfile.ZIP_DEFLATED, True), (zipfile.ZIP_BZIP2, False), (zipfile.ZIP_LZMA, False)):
        with zipfile.ZipFile(file, "w", compression) as bomb, bomb.open("modelDescription.xml", "w") as entry:
            entry.write(words)
            for _ in range(8):
                entry.write(bytes(2**20))
        tracemalloc.start()
        try:
            assert is_exported(file) is is_ours
            assert tracemalloc.get_traced_memory()[1] < 2**20
        finally:
            tracemalloc.stop()
    with file.open("wb") as large:
        large.truncate(2**40)
    assert not is_exported(file)


@pytest.mark.skipif(sys.platform == "win32", reason="no pipes there")
def test_a_pipe_at_the_default_name_is_not_waited_for(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "ArmRun.fmu")
    assert not is_exported(tmp_path / "ArmRun.fmu")


@given(st.binary(max_size=8), st.integers(0, 10**6), st.booleans())
def test_damage_to_an_fmu_makes_it_no_error(damage: bytes, place: int, is_cut: bool) -> None:
    content = archive()
    place %= len(content)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "a.fmu"
        file.write_bytes(content[:place] + damage + (b"" if is_cut else content[place + len(damage) :]))
        assert is_exported(file) in (True, False)


def test_a_model_without_a_package_gets_another_name(openmodelica: Compiler) -> None:
    Path("Cell.mo").write_text("model Cell\n  extends Arm.ArmTest;\nend Cell;\n")
    found = exported(msgspec.structs.replace(OPTIONS, model="Cell"))
    assert (found.model, found.name) == ("Cell", "Cell_FMU")
    assert openmodelica.jobs[0].tasks[0].source.startswith("model Cell_FMU ")
