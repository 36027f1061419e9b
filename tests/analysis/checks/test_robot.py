"""The check of one robot from end to end, on a robot with two joints; where it matters with compiler and Pinocchio."""

from __future__ import annotations

import importlib.util
import re
import shutil
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support import fake_omc
from support.checks import Compiling, status
from support.corpus import REPOSITORY
from support.two_joints import ARM, JOINTS, LINKS, check, codes, lines, rebuild, replace, write
from support.urdfs import robot

from urdfsync.analysis.checks import process, report
from urdfsync.analysis.checks import robot as robot_check
from urdfsync.analysis.checks.package import RobotPackage, read_package
from urdfsync.analysis.checks.results import CheckStatus
from urdfsync.engine.options import BuildOptions
from urdfsync.project import config


@pytest.mark.slow
def test_each_edit_is_told_with_what_it_changes(
    arm: Path, modelica_library: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Edits, of the eighth digit of a mass as well, are results: what is generated agrees with the reference.

    For a page poses and efforts agree over time, too, and are remembered.
    """
    Path("arm.urdf").write_text(robot(*LINKS[:2], *JOINTS[:1]))
    rebuild()
    replace(arm / "Joints" / "ShoulderParameters.mo", "damping = 0.5", "damping = 0.6")
    replace(arm / "Links" / "Arm_link_be5539Parameters.mo", "mass = 2", "mass = 2.00000002")
    replace(arm / "Links" / "Base.mo", "model Base", "// looked at\nmodel Base")
    (arm / "Own.mo").write_text("within Arm;\nmodel Own\n  Real x;\nend Own;\n")
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *_, **__: tmp_path / "cache")
    result = check(physics=True, curves=True)
    assert codes(result) == []
    assert [(one.code, one.file) for one in result.diagnostics if one.code == "unbalanced"] == [
        ("unbalanced", "modelica/Arm/Own.mo")
    ]
    assert [(one.model, one.unknowns > 100) for one in result.compiled][:3] == [
        *(("Arm", False), ("ArmRun", True), ("ArmTest", True))
    ]
    assert result.deviations
    assert not result.differs
    assert (status(result, strict=False), status(result, strict=True)) == (CheckStatus.RIGHT, CheckStatus.DIFFERS)
    elements = {effect.files: {one.element for one in effect.deviations} for effect in result.effects}
    joint, link = "Joints/ShoulderParameters.mo", "Links/Arm_link_be5539Parameters.mo"
    assert elements.keys() == {(joint,), (link,)}, "a comment is no change"
    assert elements[joint,] == {"joint shoulder"}
    assert elements[link,] >= {"robot", "joint shoulder"}
    assert {effect.owners for effect in result.effects} == {("joint shoulder",), ("link arm",)}
    curves = result.curves
    assert {curve.element for curve in curves} == {"link base", "link arm", "joint shoulder"}
    for curve in curves:
        assert len(curve.times) == 101
        assert np.abs(np.subtract(curve.values, curve.expected)).max() < 1e-9
        assert curve.element == "link base" or np.ptp(curve.values) > 0.05
    monkeypatch.setattr(robot_check, "_check", None)  # from now on all is remembered
    assert check(physics=True).curves == curves


@pytest.mark.slow
@pytest.mark.large  # test_seen_faults has many such faults
def test_a_generator_that_is_wrong_is_found_whoever_edited_what(arm: Path, modelica_library: Path) -> None:
    """A template of the user's turns origins about axes that turn along; an assertion ends each simulation."""
    templates = Path("templates")
    Path("arm.urdf").write_text(robot(*LINKS[:2], *JOINTS[:1]))
    shutil.copytree(REPOSITORY / "templates" / "urdf", templates)
    replace(templates / "macros.jinja", "{3, 2, 1}", "{1, 2, 3}")
    with Path("urdfsync.toml").open("a") as file:
        file.write('templates = "templates"\n')
    rebuild()
    replace(arm / "Joints" / "Shoulder.mo", "equation\n", 'equation\n  assert(false, "not ready yet");\n')
    result = check(physics=True, fresh=True)
    assert codes(result) == []
    assert len(result.compiled) == 3, "the edited robot compiles, although it can't be moved"
    assert status(result, strict=False) is CheckStatus.DIFFERS
    assert max(one.relative for one in result.deviations or ()) > 1e-2
    (gap,) = result.gaps
    assert "not ready yet" in gap


@pytest.mark.large
def test_what_is_compared_is_the_same_with_curves(arm: Path, modelica_library: Path) -> None:
    plain, drawn = (check(physics=True, fresh=True, curves=curves) for curves in (False, True))
    assert plain.curves == ()
    assert plain.deviations == drawn.deviations


@pytest.mark.slow
def test_what_was_right_is_not_compiled_again_until_something_changes(
    arm: Path, modelica_library: Path, compiler: Compiling
) -> None:
    first, second = check(), check()
    assert sorted(compiler.models) == ["ArmRun", "ArmTest"]
    assert [one.model for one in first.compiled] == ["Arm", "ArmRun", "ArmTest"]
    assert first.compiled == second.compiled
    assert status(second, strict=True) is CheckStatus.RIGHT
    assert first.unchecked == second.unchecked == ("poses and efforts were not compared; `--physics` compares them",)
    check(fresh=True)
    assert sorted(compiler.models) == ["ArmRun", "ArmRun", "ArmTest", "ArmTest"]
    replace(arm / "Links" / "Base.mo", "model Base", "// looked at\nmodel Base")
    compiler.problem = "something is wrong"
    assert [check().failed for _ in range(2)] == [True, True]
    assert len(compiler.models) == 10, "what is wrong is compiled again"
    compiler.problem = ""
    replace(Path("arm.urdf"), 'type="continuous"', 'type="fixed"')
    result = check()
    assert (result.in_step, status(result, strict=False)) == (False, CheckStatus.OUT_OF_STEP)
    assert [one.model for one in result.compiled] == ["Arm", "ArmRun", "ArmTest"]


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="the stand-in for omc is a script")
def test_a_remembered_check_by_one_compiler_is_none_by_both(
    arm: Path, modelica_library: Path, compiler: Compiling, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("OPENMODELICAHOME", str(tmp_path / "om"))
    for answers in ({}, {"getVersion": '"1.27"\n""\n'}):
        fake_omc.install(tmp_path / "om/bin", answers)
        compiler.models.clear()
        for tool, count in (("rumoca", 0 if answers else 2), ("omc", 2), ("both", 4)):
            before = len(compiler.models)
            results = [check(tool=tool) for _ in range(2)]
            assert len(compiler.models) - before == count, tool
            assert {status(result, strict=True) for result in results} == {CheckStatus.RIGHT}
            title = {"rumoca": "rumoca", "omc": "OpenModelica", "both": "rumoca and OpenModelica"}[tool]
            assert {result.tool for result in results} == {title}
            assert [len(result.tools) for result in results] == [2 * (tool == "both")] * 2
    compiler.problems["ArmTest"] = "something is wrong"
    failed = check(fresh=True, tool="both"), check(tool="both")
    assert [result.failed for result in failed] == [True, True], "what is wrong is compiled again"
    assert [one.model for one in failed[0].compiled] == ["Arm", "ArmRun"]
    assert len(failed[0].diagnostics) == 1, "both find it"


@pytest.mark.slow
def test_a_robot_of_which_a_joint_is_left_out_agrees_with_nothing(
    arm: Path, modelica_library: Path, compiler: Compiling
) -> None:
    replace(
        Path("arm.urdf"),
        "</robot>",
        '<loop_joint name="bar" type="planar"><link1 link="base"/><link2 link="hand"/></loop_joint></robot>',
    )
    with Path("urdfsync.toml").open("a") as file:
        file.write('allow = ["loop-joint"]\n')
    rebuild()
    result = check(physics=True)
    assert result.gaps == (
        "poses, efforts and masses were not compared: loop bar has type='planar', which is no kind of loop",
    )
    assert status(result, strict=False) is CheckStatus.INCOMPLETE
    assert "agree" not in result.summary


@pytest.mark.slow
def test_an_edited_number_is_told_without_a_compiler_and_an_edited_model_is_named(
    arm: Path, modelica_library: Path, compiler: Compiling
) -> None:
    """No number tells what an edit of a model does, so `--strict` does not call it right. A comment is no edit."""
    replace(arm / "Joints" / "ElbowParameters.mo", "damping = 0.1", "damping = 0.2")
    replace(arm / "ArmRun.mo", "connect(elbow_phi, elbowDrive", "connect(shoulder_phi, elbowDrive")
    replace(arm / "ArmRun.mo", "connect(shoulder_phi, shoulderDrive", "connect(elbow_phi, shoulderDrive")
    replace(arm / "Joints" / "Elbow.mo", "animation = false", "animation = true")
    replace(arm / "Links" / "Base.mo", "model Base", "// looked at\nmodel Base")
    result = check()
    assert result.numbers is not None
    total = result.numbers.total
    assert f"right: numbers right ({total - 1} of {total}, 1 edited); " in result.summary
    assert [sentence for sentence, _ in report._sentences(result)] == [
        "Joints/ElbowParameters.mo (edited) changes dynamics.damping of joint elbow: 0.1 in arm.urdf:7, 0.2 in line 16",
        "ArmRun.mo (edited): its effect is not compared",
        "Joints/Elbow.mo (edited): its effect is not compared",
    ]
    assert (status(result, strict=False), status(result, strict=True)) == (CheckStatus.RIGHT, CheckStatus.DIFFERS)
    replace(arm / "Joints" / "ElbowParameters.mo", "damping = 0.2", "damping = 0.1")
    result = check()
    assert (status(result, strict=False), status(result, strict=True)) == (CheckStatus.RIGHT, CheckStatus.INCOMPLETE)


def change_losses(templates: Path, losses: str) -> None:
    """Let the user's own templates write other losses of joints."""
    changed = f"<< (dict(numbers, dynamics={losses}) if numbers.dynamics else numbers) | modifiers >>"
    replace(templates / "joint" / "record.mo.jinja", "<< numbers | modifiers >>", changed)


def test_a_misread_number_differs_whoever_edited_it(
    arm: Path, modelica_library: Path, compiler: Compiling, monkeypatch: pytest.MonkeyPatch
) -> None:
    templates = Path("templates")
    shutil.copytree(REPOSITORY / "templates" / "urdf", templates)
    change_losses(templates, "dict(numbers.dynamics, damping=numbers.dynamics.friction)")
    replace(templates / "robot" / "robot.mo.jinja", "\nequation\n", '\n  parameter Real ours = 1 "Ours";\n\nequation\n')
    with Path("urdfsync.toml").open("a") as file:
        file.write('templates = "templates"\n')
    rebuild()
    replace(arm / "Joints" / "ShoulderParameters.mo", "damping = 0.2", "damping = 0.7")
    result = check()
    assert status(result, strict=False) is CheckStatus.DIFFERS
    first, second = (sentence for sentence, _ in report._sentences(result)[:2])
    assert first == (
        "modelica/Arm/Joints/ElbowParameters.mo:16: dynamics.damping of joint elbow is 0, and 0.1 in arm.urdf:7; "
        "your edits are not the cause: check your own `templates`, or report a bug, with the source"
    )
    assert second.startswith(
        "modelica/Arm/Joints/ShoulderParameters.mo:16: dynamics.damping of joint shoulder is 0.2, "
    )
    assert result.summary.startswith("differs: numbers differ (")
    assert result.numbers is not None
    assert {each.file for each in (*result.numbers.differences, *result.numbers.edits)} == {
        *("Joints/ElbowParameters.mo", "Joints/ShoulderParameters.mo")
    }


@pytest.mark.slow
def test_what_own_templates_drop_is_told_and_their_models_are_not_called_compared(
    arm: Path, modelica_library: Path, compiler: Compiling
) -> None:
    shutil.copytree(REPOSITORY / "templates" / "urdf", "templates")
    with Path("urdfsync.toml").open("a") as file:
        file.write('templates = "templates"\n')
    rebuild()
    result = check()
    assert result.unchecked[0] == "the models of your own `templates`, except their motion with `--physics`"
    assert status(result, strict=True) is CheckStatus.RIGHT
    change_losses(Path("templates"), "dict(friction=numbers.dynamics.friction)")
    rebuild()
    result = check()
    assert result.numbers is not None
    assert {(each.quantity, each.expected, each.given) for each in result.numbers.differences} == {
        ("dynamics.damping", "0.5", "nothing"),
        ("dynamics.damping", "0.1", "nothing"),
    }


def test_numbers_of_a_package_that_is_out_of_step_are_no_edits(
    arm: Path, modelica_library: Path, compiler: Compiling
) -> None:
    replace(Path("arm.urdf"), 'damping="0.1"', 'damping="0.3"')
    result = check()
    assert result.numbers is not None
    assert (result.numbers.differences, result.numbers.edits) == ((), ())
    assert status(result, strict=True) is CheckStatus.OUT_OF_STEP


@pytest.mark.slow
def test_a_check_of_what_somebody_saved_meanwhile_is_not_remembered(
    arm: Path, modelica_library: Path, compiler: Compiling, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The file is as before when it is checked the next time, but another text was right."""
    file = arm / "Links" / "Base.mo"
    before = file.read_text()

    def read_later(*arguments: Any) -> RobotPackage:
        file.write_text(f"// saved\n{before}")
        return read_package(*arguments)

    with monkeypatch.context() as patch:
        patch.setattr(robot_check, "read_package", read_later)
        assert status(check(), strict=True) is CheckStatus.RIGHT
    file.write_text(before)
    check()
    assert len(compiler.models) == 4


@pytest.mark.slow
def test_a_right_result_hides_no_mesh_that_has_changed(arm: Path, modelica_library: Path, compiler: Compiling) -> None:
    """The fingerprint has no meshes."""
    vertices = "vertex 0 0 0\nvertex {} 0 0\nvertex 0 1 0\n"
    mesh = f"solid a\nfacet normal 0 0 1\nouter loop\n{vertices}endloop\nendfacet\nendsolid\n"
    Path("part.stl").write_text(mesh.format(1))
    visual = '<visual><geometry><mesh filename="part.stl"/></geometry></visual></link>'
    Path("arm.urdf").write_text(ARM.replace("</link>", visual, 1))
    rebuild()
    assert status(check(), strict=False) is CheckStatus.RIGHT
    Path("part.stl").write_text(mesh.format(2))
    assert status(check(), strict=False) is CheckStatus.OUT_OF_STEP


def test_without_a_compiler_all_else_is_checked(
    arm: Path, modelica_library: Path, compiler: Compiling, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also the numbers, which need no extra. The gap says what to install."""
    find = importlib.util.find_spec
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None if name == "rumoca" else find(name))
    result = check()
    assert result.numbers is not None
    assert result.numbers.summary == f"numbers right ({result.numbers.total} of {result.numbers.total})"
    (gap,) = result.gaps
    assert gap.startswith("nothing was compiled: there is no compiler: rumoca is not installed; pip install")
    assert status(result, strict=False) is CheckStatus.INCOMPLETE
    asked = check(physics=True)
    assert (status(asked, strict=False), asked.gaps) == (CheckStatus.INCOMPLETE, result.gaps)
    replace(arm / "Arm.mo", "connect(shoulder.frame_b, ", "connect(sholder.frame_b, ")
    assert codes(check()) == ["unresolved"]


@pytest.mark.usefixtures("arm", "modelica_library")
def test_without_a_reference_it_is_told_before_minutes_of_compiling(
    compiler: Compiling, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing is wrong with the robot: the check is incomplete."""
    monkeypatch.setattr(process, "run", lambda function, *arguments, **_: list(function(*arguments)))
    for reference in ("pinocchio", "mujoco"):
        monkeypatch.setitem(sys.modules, f"urdfsync.formats.urdf.physics.{reference}_robot", None)
    result = check(physics=True)
    assert (status(result, strict=False), codes(result), compiler.models) == (CheckStatus.INCOMPLETE, [], [])
    assert result.numbers is not None
    (gap,) = result.gaps
    assert re.fullmatch(
        r"nothing was compiled: neither Pinocchio nor MuJoCo can be loaded, the references for physics: .*; .*; "
        r"pip install \w+, or check without `--physics`",
        gap,
    )


@pytest.mark.parametrize("built", [True, False])
def test_without_a_library_nothing_is_compiled(arm: Path, built: bool) -> None:
    """The configuration names a folder with nothing in it; a robot that is not built is checked as it would be."""
    if not built:
        shutil.rmtree(arm)
        shutil.rmtree(".urdfsync")
    Path("nothing").mkdir()
    with Path("urdfsync.toml").open("a") as file:
        file.write('[check]\nlibrary = "nothing"\n')
    result = check()
    assert (result.built, result.in_step) == (built, built)
    assert codes(result) == ["wrong-library-folder"]
    assert any("nothing was compiled" in sentence for sentence in result.gaps)


def test_nothing_is_compiled_that_does_not_parse(arm: Path) -> None:
    (arm / "Joints" / "Elbow.mo").write_text("within Arm.Joints;\nmodel Elbow\n  Real x = ;\nend Elbow;\n")
    result = check()
    assert result.failed
    assert [(one.code, one.file, one.line) for one in result.diagnostics] == [
        ("syntax", "modelica/Arm/Joints/Elbow.mo", 3),
    ]
    assert result.compiled == ()
    assert result.gaps == ("nothing was compiled, since files have errors",)


def test_a_source_with_errors_is_told(arm: Path) -> None:
    Path("arm.urdf").write_text(ARM[: len(ARM) // 2])
    result = check()
    assert result.failed
    assert result.diagnostics[0].file == "arm.urdf"


def test_a_file_that_goes_is_missed_although_the_package_was_right(
    arm: Path, modelica_library: Path, compiler: Compiling
) -> None:
    """No fingerprint knows of it. A link in the documentation is none of its business."""
    cover, hand = '  parameter String cover = "modelica://Arm/Resources/cover.stl";\n', arm / "Links" / "Hand.mo"
    replace(hand, "equation\n", f"{cover}equation\n")
    replace(hand, "end Hand;", 'end Hand; // see "<a href=modelica://Arm/Resources/none.html>"')
    (arm / "Resources").mkdir(exist_ok=True)
    (arm / "Resources" / "cover.stl").touch()
    assert [status(check(), strict=False) for _ in range(2)] == [CheckStatus.RIGHT] * 2
    assert len(compiler.models) == 2
    (arm / "Resources" / "cover.stl").unlink()
    (found,) = check().diagnostics
    line = hand.read_text().split("\n").index(cover.rstrip("\n")) + 1
    assert (found.code, found.file, found.line) == ("missing-resource", "modelica/Arm/Links/Hand.mo", line)
    assert len(compiler.models) == 2


@pytest.mark.parametrize(
    ("files", "models", "roots"),
    [
        ({"Cell.mo": "model Cell\n  Arm.Arm a;\nend Cell;\n"}, ["Cell"], ["Cell.mo"]),
        ({"Arm/Own.mo": "within Arm;\nmodel Own\n  Arm a;\nend Own;\n"}, ["Arm.Own"], []),
        (
            {
                "Plant/package.mo": "package Plant\nend Plant;\n",
                "Plant/Cells/package.mo": "within Plant;\npackage Cells\n  model Two = Arm.Arm;\nend Cells;\n",
                "Plant/Cells/One.mo": "within Plant.Cells;\nblock One\n  Arm.Arm a;\nend One;\n",
                "Plant/Base.mo": "within Plant;\npartial model Base\n  Arm.Arm a;\nend Base;\n",
            },
            ["Plant.Cells.One", "Plant.Cells.Two"],
            ["Plant"],
        ),
    ],
)
def test_models_in_the_package_and_beside_it_are_compiled_with_it(
    arm: Path, modelica_library: Path, compiler: Compiling, files: dict[str, str], models: list[str], roots: list[str]
) -> None:
    write(files)
    result = check()
    assert [one.model for one in result.compiled if one.is_users] == models
    assert {str(Path("modelica", root).resolve()) for root in roots} <= set(compiler.roots)
    assert (status(result, strict=True), result.gaps) == (CheckStatus.RIGHT, ())


@pytest.mark.parametrize(
    ("file", "text"),
    [
        ("Other.mo", "model Cell\n  Arm.Arm a;\nend Cell;\n"),
        ("Cell.mo", "within Plant;\nmodel Cell\n  Arm.Arm a;\nend Cell;\n"),
        ("Cell.mo", "model Cell\n  Arm.Arm a;\nend Cell;\nmodel Cell2\nend Cell2;\n"),
    ],
)
def test_a_model_that_no_compiler_would_find_keeps_the_verdict_from_being_right(
    arm: Path, modelica_library: Path, compiler: Compiling, file: str, text: str
) -> None:
    write({file: text})
    result = check()
    assert status(result, strict=False) is CheckStatus.INCOMPLETE
    assert result.gaps == (f"modelica/{file} outside of the package: nothing there was compiled",)


@pytest.mark.parametrize("is_edited", [False, True])
def test_the_robot_compiles_as_a_part_of_test_and_alone_if_that_fails_or_is_edited(
    arm: Path, modelica_library: Path, compiler: Compiling, is_edited: bool
) -> None:
    assert [one.model for one in check().compiled] == ["Arm", "ArmRun", "ArmTest"]
    assert sorted(compiler.models) == ["ArmRun", "ArmTest"]
    compiler.models.clear()
    if is_edited:
        for bench in ("ArmRun.mo", "ArmTest.mo"):
            replace(arm / bench, '    "The robot"', '    if false "The robot"')
    else:
        compiler.problems["ArmTest"] = "all is wrong"
    result = check(fresh=True)
    assert sorted(compiler.models) == ["Arm", "ArmRun", "ArmTest"]
    assert "Arm" in [one.model for one in result.compiled]


def test_a_model_of_the_user_that_does_not_compile_is_a_warning_at_its_file(
    arm: Path, modelica_library: Path, compiler: Compiling
) -> None:
    write({"Cell.mo": "model Cell\n  Arm.Arm a;\nend Cell;\n"})
    compiler.problems["Cell"] = "unbalanced model: 2 equations, 3 unknowns"
    result = check()
    assert (result.failing, len(result.compiled)) == (("Cell",), 3)
    hint = "a component of other models need not compile by itself"
    assert lines(result) == [f"Cell.mo:0: warning: there is 1 equation too few; {hint}"]


@pytest.mark.slow
def test_a_part_of_a_model_that_compiles_need_not_compile_by_itself(
    arm: Path, modelica_library: Path, compiler: Compiling
) -> None:
    part, line = "model Part\n  Arm.Arm a;\nend Part;\n", "model Line\n  Part part;\nend Line;\n"
    write({"Part.mo": part, "Line.mo": line})
    compiler.problems["Part"] = "unbalanced model: 2 equations, 3 unknowns"
    result = check()
    assert (result.failing, result.diagnostics) == ((), ())
    compiler.problems["Line"] = compiler.problems["Part"]
    assert check(fresh=True).failing == ("Line", "Part")


def test_a_component_that_compiles_inside_of_its_robot_need_not_compile_by_itself(
    arm: Path, modelica_library: Path, compiler: Compiling
) -> None:
    """So does a component of this component. If nothing uses it, its warning stays."""
    brake = "Modelica.Mechanics.Rotational.Components.Damper"
    write({"Arm/Brake.mo": f"within Arm;\nmodel Brake\n  extends {brake};\nend Brake;\n"})
    write({"Arm/Soft.mo": "within Arm;\nmodel Soft\n  extends Joints.Elbow;\n  Brake brake(d = 1);\nend Soft;\n"})
    compiler.problems |= dict.fromkeys(("Arm.Brake", "Arm.Soft"), "every component needs a root")
    assert check().failing == ("Arm.Brake", "Arm.Soft")
    replace(arm / "Arm.mo", "replaceable Joints.Elbow elbow(", "replaceable Soft elbow(")
    result = check()
    assert (result.failing, {one.code for one in result.diagnostics}) == ((), {"order-lacks"})


def test_other_line_ends_are_no_edit_and_comments_move_nothing(arm: Path) -> None:
    base = arm / "Links" / "Base.mo"
    base.write_bytes(base.read_bytes().replace(b"\n", b"\r\n"))
    replace(arm / "Links" / "Hand.mo", "model Hand", "// looked at\nmodel Hand")
    replace(arm / "Joints" / "ElbowParameters.mo", "damping = 0.1", "damping = 0.2")
    loaded = config.load(Path("urdfsync.toml").absolute())
    package = read_package(loaded, loaded.robots[0], BuildOptions(dry=True))
    assert package.files.edited == ["Joints/ElbowParameters.mo", "Links/Hand.mo"]
    assert package.edits == ("Joints/ElbowParameters.mo",)


def test_a_model_whose_new_name_waits_is_not_the_users(arm: Path) -> None:
    """The package on disk has the old names until the conflict is resolved."""
    replace(arm / "Arm.mo", "shoulder(", "shoulder(fixedStart = true, ")
    replace(arm / "Joints" / "Elbow.mo", "model Elbow", "// looked at\nmodel Elbow")
    source = Path("arm.urdf")
    source.write_text(source.read_text().replace('"elbow"', '"hinge"').replace('name="shoulder"', 'name="lift"'))
    loaded = config.load(Path("urdfsync.toml").absolute())
    package = read_package(loaded, loaded.robots[0], BuildOptions(dry=True))
    assert package.conflicting
    assert arm / "Joints/Elbow.mo" not in package.own_files
    assert package.own_files == {}
