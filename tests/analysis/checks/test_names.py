"""Names that mean nothing, in the package and in files of the user: what is said, where, and of which files."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Sequence
from pathlib import Path

import pytest
from support.checks import Compiling
from support.two_joints import check, lines, rebuild, replace, write

BROKEN = {
    "MyArm.mo": """\
within;
model MyArm
  extends Arm.Arm(redeclare Arm.Joints.Elbow elbo, elbow(parameters(dynamics(dampin = 5))));
  Arm.Links.Hnd other;
  parameter Real load = 2;
equation
  connect(elbwo.axis, elbow.axis);
end MyArm;
""",
    "Bench/MyBench.mo": """\
model MyBench
  extends Arm.ArmTest(robot(redeclare Arm.Joints.Elbow elbow));
  MyArm mine;
  Real x = mine.laod + robot.elbow.axs.tau;
  Real y = whatever.it.is;
end MyBench;
""",
    "Notes.mo": "model Notes\n  Nothing here;\nend Notes;\n",
    "Draft.mo": "model Draft\n  Arm.Arm arm\nend Draft;\n",
}


@pytest.mark.usefixtures("arm", "modelica_library", "compiler")
def test_after_a_rename_the_new_names_are_named_as_by_the_build() -> None:
    """Other names are more like the former ones."""
    write({"MyArm.mo": "within;\nmodel MyArm\n  extends Arm.Arm;\n  Arm.Links.Hand other;\n"
                       "  Real x = elbowAxis.tau + hand.m;\nend MyArm;\n"})  # fmt: skip
    replace(Path("arm.urdf"), '"elbow"', '"wrist"')
    replace(Path("arm.urdf"), '"hand"', '"paw"')
    rebuild()
    assert lines(check()) == [
        "MyArm.mo:4: error: there is no class `Arm.Links.Hand`; use `Paw` instead",
        "MyArm.mo:5: error: MyArm has no `elbowAxis`; use `wristAxis` instead",
        "MyArm.mo:5: error: MyArm has no `hand`; use `paw` instead",
    ]


def test_a_user_reads_what_is_missing_in_files_around(arm: Path, modelica_library: Path, compiler: Compiling) -> None:
    write(BROKEN)
    result = check()
    nested = "the redeclaration of `elbow` inside of another modifier is not checked: rumoca ignores it"
    assert lines(result) == [
        "Draft.mo:3: warning: the file lacks `;` before `end`; ",
        f"Bench/MyBench.mo:2: warning: {nested}; "
        "write a model that says `extends Arm.Arm(redeclare … elbow)`, and use that instead",
        "Bench/MyBench.mo:4: error: MyArm has no `laod`; did you mean `mine.load`?",
        "Bench/MyBench.mo:4: error: Elbow has no `axs`; did you mean `robot.elbow.axis.tau`?",
        "Bench/MyBench.mo:5: error: MyBench has no `whatever`; change or remove this use",
        "MyArm.mo:3: error: Arm has no `elbo`; did you mean `elbow`?",
        "MyArm.mo:3: error: RotationalDynamics has no `dampin`; did you mean `damping`?",
        "MyArm.mo:4: error: there is no class `Arm.Links.Hnd`; did you mean `Arm.Links.Hand`?",
        "MyArm.mo:7: error: MyArm has no `elbwo`; did you mean `elbow.axis`?",
    ]
    assert result.failed
    assert [one.model for one in result.compiled if one.is_users] == ["MyBench", "MyArm"]
    assert len(result.compiled) == 5, "the package itself is right"
    assert result.gaps == ("modelica/Draft.mo outside of the package: nothing there was compiled",)


def test_only_models_whose_names_mean_the_package_are_compiled_with_it(
    arm: Path, modelica_library: Path, compiler: Compiling
) -> None:
    """`Elbow` and `Arm` are words that other robots have as well."""
    other = "within Other;\nmodel %s\n  %s part;\nend %s;\n"
    write(
        {
            "Other/package.mo": "package Other\nend Other;\n",
            "Other/Elbow.mo": other % ("Elbow", "Real", "Elbow"),
            "Other/Arm.mo": other % ("Arm", "Elbow", "Arm"),
            "Other/Bad.mo": other % ("Bad", "Arm.nothing", "Bad"),
            "Cell.mo": "model Cell\n  Arm.Arm a;\nend Cell;\n",
            "Line.mo": "model Line\n  Cell cell;\nend Line;\n",
            "Elsewhere.mo": "model Elsewhere\n  Other.Arm arm;\n  Real x = Elbow.y;\nend Elsewhere;\n",
        }
    )
    result = check()
    assert (result.diagnostics, result.gaps) == ((), ())
    assert [one.model for one in result.compiled if one.is_users] == ["Cell", "Line"]


def test_a_library_of_the_users_models_is_not_loaded_for_the_package(
    arm: Path, modelica_library: Path, compiler: Compiling, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """If it cannot be read, the package is compiled all the same."""
    (tmp_path / "Rig").mkdir()
    (tmp_path / "Rig/package.mo").write_text("package Rig\n  model Part\n  end Part;\nend Rig;\n")
    monkeypatch.setenv("MODELICAPATH", f"{modelica_library}{os.pathsep}{tmp_path}")
    write({"Cell.mo": "model Cell\n  Arm.Arm a;\n  Rig.Part p;\nend Cell;\n"})
    assert not check().diagnostics
    loaded = {model: "Rig" in " ".join(roots) for model, roots in compiler.roots_of.items()}
    assert {model for model, has_rig in loaded.items() if has_rig} == {"Cell"}


def test_the_package_is_not_compiled_if_names_in_it_mean_nothing(arm: Path, without_library: None) -> None:
    replace(arm / "Arm.mo", "connect(shoulder.frame_b, ", "connect(sholder.frame_b, ")
    result = check()
    (line,) = lines(result)
    assert "error: robot: Arm has no `sholder`; did you mean `shoulder.frame_b`?" in line
    assert line.endswith("the file was edited by hand")
    assert result.gaps == ("nothing was compiled, since the package uses missing names",)


def test_a_frame_that_the_configuration_does_not_list_is_told_with_its_key(arm: Path, without_library: None) -> None:
    bench = "model Bench\n  Arm.Arm robot;\nequation\n  connect(robot.%s, robot.frame_a);\nend Bench;\n"
    with Path("urdfsync.toml").open("a") as file:
        file.write('frames = ["arm"]\n')
    rebuild()
    frames = re.findall(r"Frame_b (\w+)", (arm / "Arm.mo").read_text())
    (name,) = [name for name in frames if "arm" in name.lower()]
    write({"Bench.mo": bench % name})
    assert lines(check()) == []
    replace(Path("urdfsync.toml"), 'frames = ["arm"]\n', 'frames = ["base"]\n')
    rebuild()
    assert lines(check()) == [
        f'Bench.mo:4: error: Arm has no `{name}`; set `frames = ["base", "arm"]` to bring it back'
    ]


@pytest.mark.parametrize(
    ("files", "expected"),
    [
        (  # of the classes of that library which UrdfSync extends, the elements are known
            {"MyArm.mo": BROKEN["MyArm.mo"]},
            [
                "MyArm.mo:3: error: Arm has no `elbo`",
                "MyArm.mo:3: error: RotationalDynamics has no `dampin`",
                "MyArm.mo:4: error: there is no class `Arm.Links.Hnd`",
                "MyArm.mo:7: error: MyArm has no `elbwo`",
            ],
        ),
        (
            {"Own.mo": "model Own\n  extends Arm.Joints.Elbow;\n  Real x = wrong.x;\nend Own;\n"},
            ["Own.mo:3: error: Own has no `wrong`"],
        ),
        ({"Own.mo": "model Own\n  extends Modelica.Math.M;\n  Arm.Arm a;\n  Real x = inherited.x;\nend Own;\n"}, []),
        ({".backup/MyArm.mo": BROKEN["MyArm.mo"], "Resources/MyArm.mo": BROKEN["MyArm.mo"]}, []),
    ],
)
def test_without_the_standard_library_nothing_is_said_of_what_it_may_hold(
    arm: Path, without_library: None, files: dict[str, str], expected: Sequence[str]
) -> None:
    write(files)
    assert [line.partition(";")[0] for line in lines(check())] == expected


def test_packages_of_other_robots_are_left_alone(arm: Path, without_library: None) -> None:
    shutil.copytree(arm, arm.parent / "Other")
    with Path("urdfsync.toml").open("a") as file:
        file.write('[robots.other]\nsource = "arm.urdf"\npackage = "Other"\n')
    write({"Other/Bad.mo": "within Other;\nmodel Bad\n  Arm.Bad bad;\nend Bad;\n"})
    assert lines(check()) == []


def test_files_below_a_package_that_uses_the_robots_are_no_users(arm: Path, without_library: None) -> None:
    write(
        {
            "Other/package.mo": "package Other\n model P\n  Arm.Arm a;\n end P;\nend Other;\n",
            "Other/Bad.mo": "within Other;\nmodel Bad\n  Nothing here;\nend Bad;\n",
        }
    )
    assert lines(check()) == []


def test_one_fault_in_several_lines_is_one_finding(arm: Path, without_library: None) -> None:
    uses = "".join(f"  Real {name} = arm.elbo.phi;\n" for name in "xyz")
    write({"Own.mo": f"model Own\n  Arm.Arm arm;\n{uses}end Own;\n"})
    assert lines(check()) == [
        "Own.mo:3: error: Arm has no `elbo`; did you mean `arm.elbow.phi`?; also in lines 4 and 5"
    ]
