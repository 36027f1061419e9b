"""Imported files: what is copied, where it is looked for, and what serves while it is missing."""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import Any

import msgspec
import pytest
from support import crashes
from support.files import unchanged
from support.networks import LADDER, edit, resistor, run, said, source
from support.networks import inner_kinds as kinds
from support.replay import contents

from urdfsync.common.diagnostics import Severity
from urdfsync.domain import Conversion, Dependency, registry
from urdfsync.engine.actions import Reason


def test_a_dependency_that_was_never_found_is_left_out(project: Path) -> None:
    Path("step.csv").unlink()
    Path("step.csv").mkdir()
    assert said(run()) == [
        "ladder.json:3: warning: table `step.csv` not found; left out; "
        "put it there, or name the folder where this path begins in the robot's `package_paths` [table-not-found]"
    ]
    assert not (project / LADDER / "Resources").exists()
    assert "SignalVoltage" not in (project / LADDER / "Ladder.mo").read_text()
    assert run().in_step
    Path("step.csv").rmdir()
    Path("step.csv").write_text("0,1\n")
    assert kinds(run()) == {"Resources/step.txt": Reason.CREATE, "Ladder.mo": Reason.UPDATE}


def test_ros_package_path_is_searched(project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    Path("step.csv").rename(tmp_path / "step.csv")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    run()
    assert (project / LADDER / "Resources/step.txt").exists()


def test_a_dependency_that_differs_in_case_only_names_the_file(project: Path) -> None:
    """Exports are made where that makes no difference."""
    Path("step.csv").rename("STEP.CSV")
    if Path("step.csv").exists():
        pytest.skip("here it makes no difference, either")
    assert said(run()) == [
        "ladder.json:3: warning: table `step.csv` not found; there is `STEP.CSV`; left out; "
        "rename it, or correct the case in the source [table-not-found]"
    ]


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes on this system")
def test_a_dependency_that_cant_be_opened_is_not_called_missing(project: Path) -> None:
    Path("step.csv").unlink()
    os.mkfifo("step.csv")
    assert said(run()) == [
        "ladder.json:3: warning: table `step.csv` can't be read: it is not a regular file; left out; "
        "replace it by a table that can be read [table-unreadable]"
    ]


def test_the_copy_serves_where_a_dependency_cant_be_found(project: Path) -> None:
    run()
    with unchanged(project / LADDER):
        Path("step.csv").unlink()
        assert run().in_step
        for request in ({"full": True}, {"full": True, "dry": True}):
            result = run(**request)
            assert [found.code for found in result.diagnostics] == ["table-not-found-kept"]
            assert result.in_step
    resistor(120)
    assert kinds(run()) == {"Elements/R1Parameters.mo": Reason.UPDATE}
    edit("urdfsync.toml", '"Ladder"', '"Filter"')
    run()
    assert Path("modelica/Filter/Resources/step.txt").exists()
    assert not (project / LADDER).exists()


def test_an_edited_copy_is_kept_and_the_older_one_serves_until_its_source_is_back(project: Path) -> None:
    run()
    signal, copy = Path("step.csv"), Path(LADDER, "Resources/step.txt")
    original = copy.read_bytes()
    copy.write_bytes(b"mine")
    assert kinds(run(full=True)) == {"Resources/step.txt": Reason.KEEP}
    edit(signal, "0.1,5", "0.1,7")
    content = signal.read_bytes()
    assert kinds(run()) == {"Resources/step.txt": Reason.CONFLICT}
    assert copy.read_bytes() == b"mine"
    signal.unlink()
    assert kinds(run()) == {"Resources/step.txt": Reason.KEEP}
    copy.write_bytes(original)
    for request in ({}, {}, {"full": True}):
        assert run(**request).in_step
        assert copy.read_bytes() == original
    signal.write_bytes(content)
    assert kinds(run()) == {"Resources/step.txt": Reason.UPDATE}
    assert "0.1 7.0" in copy.read_text()
    assert run().in_step


def test_a_further_file_of_an_import_that_is_gone_comes_back(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    domain = registry.domain("rcnetwork")

    def convert(dependency: Dependency, *arguments: Any) -> Conversion:
        return msgspec.structs.replace(real(dependency, *arguments), more=(Conversion(b"2", {}),))

    real = domain.convert
    monkeypatch.setattr(type(domain), "convert", lambda _, *arguments: convert(*arguments))
    run()
    further = Path(LADDER, "Resources/step_1.txt")
    assert further.read_text() == "2"
    further.unlink()
    assert kinds(run()) == {"Resources/step_1.txt": Reason.RESTORE}
    assert further.read_text() == "2"


def test_a_file_is_converted_again_only_if_it_or_its_copy_changed(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    domain, converted = registry.domain("rcnetwork"), list[str]()
    real = domain.convert

    def convert(dependency: Dependency, *arguments: Any) -> Conversion:
        converted.append(dependency.uri)
        return real(dependency, *arguments)

    monkeypatch.setattr(type(domain), "convert", lambda _, *arguments: convert(*arguments))
    run()
    resistor(120)
    run()
    assert converted == ["step.csv"]
    Path(LADDER, "Resources/step.txt").write_bytes(b"mine")
    resistor(130, 120)
    run()
    assert converted == ["step.csv"] * 2
    edit("step.csv", "0.1,5", "0.1,7")
    run(dry=True)
    assert converted == ["step.csv"] * 3
    run(full=True)
    assert converted == ["step.csv"] * 4


LFS = b"version https://git-lfs.github.com/spec/v1\noid sha256:4d\nsize 12\n"

POINTER = "it is a Git LFS pointer; left out; get the file itself with `git lfs pull`"


@pytest.mark.parametrize(("bad", "words"), [(b"no numbers\n", "could not convert"), (LFS, POINTER)])
@pytest.mark.parametrize("before", [False, True], ids=["never converted", "converted before"])
def test_a_file_that_cant_be_converted_is_told(project: Path, before: bool, bad: bytes, words: str) -> None:
    good = Path("step.csv").read_bytes()
    if before:
        run()
    Path("step.csv").write_bytes(bad)
    for _ in range(2):
        (found,) = run().diagnostics
        assert found.code == f"table-unreadable{'-kept' * before}"
        assert before or words in str(found)
    Path("step.csv").write_bytes(good)
    assert run().diagnostics == ()
    assert run().in_step


@pytest.mark.parametrize(
    ("uri", "hint"),
    [
        (
            "package://ladder_data/step.csv",
            "put it into the package `ladder_data`, or name the folder around that in the robot's `package_paths`",
        ),
        ("modelica://Ladder.Data/step.csv", "put the folder that holds the library `Ladder` on MODELICAPATH"),
        ("tables/step.csv", "put it there, or name the folder where this path begins in the robot's `package_paths`"),
        ("file:///opt/step.csv", "put it there, or let the source refer to it by a package or a relative path"),
        ("D:/tables/step.csv", "put it there, or let the source refer to it by a package or a relative path"),
        ("HTTPS://host/step.csv", "urdfsync downloads no files: download it, and let the source refer to your copy"),
    ],
)
def test_what_to_do_about_a_file_that_is_not_found_goes_by_its_reference(project: Path, uri: str, hint: str) -> None:
    source('"step.csv"', f'"{uri}"')
    (found,) = run().diagnostics
    assert (found.message, found.hint) == (f"table `{uri}` not found; left out", hint)


# Meshes of a robot


@pytest.mark.slow
def test_outermost_points_of_meshes_are_found_once_the_robot_touches_the_ground(workspace: Path) -> None:
    """Whether the meshes are there or not, what is built in the end is what one build makes of it."""
    crashes.run(workspace)
    assert '"hull"' not in (workspace / ".urdfsync/robots/arm.state").read_text()
    meshes = workspace / "ws/src/six_axis_arm/meshes"
    meshes.rename(workspace / "away")
    configuration = (workspace / "urdfsync.toml").read_text()
    (workspace / "urdfsync.toml").write_text(configuration + 'base = "floating"\n')
    (error,) = crashes.run(workspace).diagnostics
    assert (error.severity, error.code) == (Severity.ERROR, "lost-state")
    assert error.message.endswith("the record of its imported copy is incomplete")
    (workspace / "away").rename(meshes)
    crashes.run(workspace)
    assert '"hull"' in (workspace / ".urdfsync/robots/arm.state").read_text()
    found = contents(workspace / "modelica")
    shutil.rmtree(workspace / "modelica")
    shutil.rmtree(workspace / ".urdfsync")
    crashes.run(workspace)
    assert contents(workspace / "modelica") == found
    (workspace / "urdfsync.toml").write_text(configuration)
    crashes.run(workspace)
    assert '"hull"' not in (workspace / ".urdfsync/robots/arm.state").read_text()


def test_meshes_of_a_modelica_library_are_imported(workspace: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The library on MODELICAPATH comes before a folder of its name beside the source."""
    folder = workspace / "ws" / "src" / "six_axis_arm"
    source = folder / "six_axis_arm.urdf"
    source.write_text(source.read_text().replace("package://six_axis_arm/meshes/", "modelica://ArmMeshes/Resources/"))
    library = workspace / "libraries" / "ArmMeshes 1.2.0"
    library.mkdir(parents=True)
    (library / "package.mo").write_text("package ArmMeshes\nend ArmMeshes;\n")
    shutil.move(folder / "meshes", library / "Resources")
    monkeypatch.setenv("MODELICAPATH", "")
    result = crashes.run(workspace)
    assert {found.code for found in result.diagnostics} == {"mesh-not-found"}
    assert "`ArmMeshes` on MODELICAPATH" in (result.diagnostics[0].hint or "")
    monkeypatch.setenv("MODELICAPATH", str(workspace / "libraries"))
    assert crashes.run(workspace).diagnostics == ()
    assert len(list((workspace / "modelica/Arm/Resources").iterdir())) == 7
    beside = folder / "ArmMeshes" / "Resources"
    shutil.copytree(library / "Resources", beside)
    (beside / "carousel.obj").write_text("no mesh")
    assert crashes.run(workspace).in_step
    monkeypatch.setenv("MODELICAPATH", "")
    assert {found.code for found in crashes.run(workspace).diagnostics} == {"mesh-unreadable-kept"}


def test_missing_meshes_are_one_warning_for_each_package(workspace: Path) -> None:
    shutil.rmtree(workspace / "ws/src/six_axis_arm/meshes")
    source = workspace / "ws/src/six_axis_arm/six_axis_arm.urdf"
    text = source.read_text()
    source.write_text(text.replace("package://six_axis_arm/meshes/carousel.obj", "package://turntable/carousel.obj"))

    def told(full: bool = False) -> list[str]:
        found = [
            one for one in crashes.run(workspace, full=full).diagnostics if one.code not in ("density", "inertia-size")
        ]
        return [str(one).partition(": ")[2] for one in found]

    warnings = [
        "warning: 6 meshes (such as `package://six_axis_arm/meshes/base_casting.stl`) not found; left out; "
        "put it into the package `six_axis_arm`, or name the folder around that in the robot's `package_paths` "
        "[mesh-not-found]",
        "warning: mesh `package://turntable/carousel.obj` not found; left out; "
        "put it into the package `turntable`, or name the folder around that in the robot's `package_paths` "
        "[mesh-not-found]",
    ]
    assert told() == warnings
    source.write_text(source.read_text().replace('<mass value="', '<mass value="1'))
    jump, *others = told()
    assert others == warnings
    words = "link drive_pinion: its mass jumps, 0.045 kg → 10.045 kg (and 5 more like it); "
    assert jump.startswith(f"warning: since this export: {words}")
    assert told(full=True) == warnings


def test_meshes_from_a_folder_of_another_name_are_one_warning_for_each_package(workspace: Path) -> None:
    (workspace / "ws/src/six_axis_arm").rename(workspace / "ws/src/arm-main")
    edit(workspace / "urdfsync.toml", "ws/src/six_axis_arm/", "ws/src/arm-main/")
    (found,) = crashes.run(workspace).diagnostics
    assert (found.severity, found.code) == (Severity.NOTE, "mesh-guessed")
    assert found.message == (
        "7 meshes (such as `package://six_axis_arm/meshes/base_casting.stl`) are taken from a folder "
        "with another name than the package `six_axis_arm`"
    )
    for mesh in (workspace / "ws/src/arm-main/meshes").iterdir():
        if mesh.name != "carousel.obj":
            mesh.unlink()
    said = {found.code: found.message for found in crashes.run(workspace).diagnostics}
    assert "`package://six_axis_arm/meshes/carousel.obj` is taken from" in said["mesh-guessed"]


def test_meshes_are_imported_and_named_by_modelica_uris(workspace: Path) -> None:
    crashes.run(workspace)
    resources = {p.name for p in (workspace / "modelica/Arm/Resources").iterdir()}
    texts = "".join(p.read_text() for p in (workspace / "modelica/Arm/Links").glob("*Parameters.mo"))
    assert len(resources) == 7
    assert all(f'"modelica://Arm/Resources/{name}"' in texts for name in resources)
    assert "package://" not in texts
