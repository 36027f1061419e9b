"""`urdfsync diff --edits --patch`: the edits of records as a patch of the source, for `git apply`."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from support import xacros
from support.commands import Execute
from support.files import unchanged
from support.git import NEEDS_GIT, Repository
from support.patches import patch_and_told
from support.urdfs import ELBOW_ARM

from urdfsync.engine.sources import expansion
from urdfsync.project.state.expansion import Expansion

pytestmark = NEEDS_GIT
CONFIG = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n'
FORE, ELBOW = "modelica/Arm/Links/ForeParameters.mo", "modelica/Arm/Joints/ElbowParameters.mo"
HEAD = '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
BASE, CALL, INCLUDE = (
    '<link name="base"/>\n',
    '<xacro:wheel name="{}" mass="{}"/>\n',
    '<xacro:include filename="{}.xacro"/>\n',
)
WHEEL = """\
  <xacro:macro name="wheel" params="name mass">
    <link name="${name}">
      <inertial><mass value="${mass}"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    </link>
    <joint name="to_${name}" type="continuous"><parent link="base"/><child link="${name}"/><axis xyz="0 1 0"/></joint>
  </xacro:macro>
"""


@pytest.fixture
def repository(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Repository:
    return Repository(folder, monkeypatch)


def build(execute: Execute, files: dict[str, str | bytes], config: str = CONFIG) -> None:
    """Write a project into the working folder, and build it."""
    for name, content in {**files, "urdfsync.toml": config}.items():
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).write_bytes(content.encode() if isinstance(content, str) else content)
    execute("build", "--quiet")


def edit(path: str, *pairs: tuple[str, str]) -> None:
    """Replace texts that are in a file once."""
    text = Path(path).read_text()
    for old, new in pairs:
        assert text.count(old) == 1, (old, text)
        text = text.replace(old, new)
    Path(path).write_text(text)


def apply(repository: Repository, execute: Execute, edits: list[str] | None = None) -> list[str]:
    """Apply the patch, build, and assert that these lines tell what is still edited; return what stays."""
    with unchanged(repository.folder):
        patch, told = patch_and_told()
    subprocess.run(["git", "apply"], input=patch, check=True, cwd=repository.folder)
    execute("build", "--quiet")
    execute("build", "--check", "--quiet")
    lines = execute("diff", "--edits").lines
    assert lines == (edits or ["arm: nothing is edited"]), lines
    return told


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1", "utf-16"])
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_only_the_literals_change(repository: Repository, execute: Execute, encoding: str, end: str) -> None:
    """Encoding, byte order mark, line ends, quotes, order of attributes and all other numbers stay."""
    name = encoding.removesuffix("-sig").replace("latin-1", "iso-8859-1")
    source = (
        (
            f'<?xml version="1.0" encoding="{name}"?>\n<!-- Größe 2.5 -->\n'
            + ELBOW_ARM.replace('<mass value="2.5"/>', "<mass   value = '2.50e0' />").replace(
                'effort="5"', "effort='005.'"
            )
        )
        .replace("\n", end)
        .encode(encoding)
    )
    build(execute, {"arm.urdf": source})
    edit(FORE, ("mass = 2.5", "mass = 3.25e-2"), ("izz = 1", "izz = 1.5"))
    edit(ELBOW, ("effort = 5", "effort = 6"), ("axis = {0, 0, 1}", "axis = {0, -1, 0}"))
    expected = source.decode(encoding)
    for old, new in (("'2.50e0'", "'3.25e-2'"), ('izz="1"', 'izz="1.5"'), ("'005.'", "'6'"), ("0 0 1", "0 -1 0")):
        assert expected.count(old) == 1
        expected = expected.replace(old, new)
    spelled = ["arm: 1 file edited", f"  {FORE}  link fore", "    only blanks, or the order of things"]
    assert apply(repository, execute, spelled) == []
    assert Path("arm.urdf").read_bytes() == expected.encode(encoding)


def test_a_patch_names_file_and_line(repository: Repository, execute: Execute) -> None:
    build(execute, {"arm.urdf": ELBOW_ARM})
    edit(FORE, ("mass = 2.5", "mass = 3"))
    patch, told = patch_and_told()
    line = '    <inertial><mass value="{}"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>\n'
    assert told == []
    assert patch.decode() == (
        "diff --git a/arm.urdf b/arm.urdf\n--- a/arm.urdf\n+++ b/arm.urdf\n@@ -1,7 +1,7 @@\n"
        ' <robot name="arm">\n   <link name="base"/>\n   <link name="fore">\n'
        f"-{line.format('2.5')}+{line.format('3')}"
        '   </link>\n   <joint name="elbow" type="revolute">\n'
        f" {ELBOW_ARM.splitlines()[6]}\n"
    )


def test_a_zero_has_no_sign(repository: Repository, execute: Execute) -> None:
    """`-0.0` is the zero that the source and the generated text have then: no conflict."""
    build(execute, {"arm.urdf": ELBOW_ARM})
    edit(ELBOW, ("upper = 1,", "upper = -0.0,"), ("xyz = {0, 0, 0}", "xyz = {-0.0, 0, 0.5}"))
    spelled = ["arm: 1 file edited", f"  {ELBOW}  joint elbow", "    only blanks, or the order of things"]
    assert apply(repository, execute, spelled) == []


def test_nothing_is_edited(repository: Repository, execute: Execute) -> None:
    build(execute, {"arm.urdf": ELBOW_ARM})
    assert patch_and_told() == (b"", [])


def test_what_the_source_leaves_out_is_inserted(repository: Repository, execute: Execute) -> None:
    build(execute, {"arm.urdf": ELBOW_ARM.replace('<axis xyz="0 0 1"/>', "")})
    edit(ELBOW, ("xyz = {0, 0, 0}", "xyz = {0, 0, 0.5}"), ("axis = {1, 0, 0}", "axis = {0, 1, 0}"))
    edit(ELBOW, ("velocity = 2,", "velocity = 2,\n      acceleration = 3,"))
    told = apply(
        repository,
        execute,
        [
            "arm: 1 file edited",
            f"  {ELBOW}  joint elbow",
            "    extends `UrdfSync.Records.RevoluteJoint`: limits.acceleration added",
        ],
    )
    (line,) = told  # `acceleration` is of URDF 1.2, and the file is of 1.0
    assert line.startswith(f"{ELBOW}: limits.acceleration (none) → 3: stays, since ")
    text = Path("arm.urdf").read_text()
    assert '<origin xyz="0 0 0.5"/>' in text
    assert '<axis xyz="0 1 0"/>' in text


def test_a_new_element_has_all_new_attributes(repository: Repository, execute: Execute) -> None:
    build(execute, {"arm.urdf": ELBOW_ARM})
    edit(ELBOW, ("xyz = {0, 0, 0}", "xyz = {0, 0, 0.5}"), ("rpy = {0, 0, 0}", "rpy = {0, 1.5, 0}"))
    assert apply(repository, execute) == []
    assert '\n    <origin xyz="0 0 0.5" rpy="0 1.5 0"/>\n' in Path("arm.urdf").read_text()


def test_an_attribute_is_inserted_in_the_quotes_of_its_tag(repository: Repository, execute: Execute) -> None:
    build(execute, {"arm.urdf": ELBOW_ARM.replace('<axis xyz="0 0 1"/>', "<origin xyz='0 0 1'/>")})
    edit(ELBOW, ("rpy = {0, 0, 0}", "rpy = {0, 0, 1.5}"))
    assert apply(repository, execute) == []
    assert "<origin xyz='0 0 1' rpy='0 0 1.5'/>" in Path("arm.urdf").read_text()


@pytest.mark.parametrize(
    ("old", "new", "why"),
    [
        ("mass = 2.5", "mass = 2*3", "it is no plain decimal number"),
        ("mass = 2.5", "mass = Modelica.Constants.inf", "it is no plain decimal number"),
        ("mass = 2.5", "mass = -1", "the source would be wrong: link fore / inertial: the mass -1 kg is negative"),
    ],
)
def test_what_no_source_states_stays(repository: Repository, execute: Execute, old: str, new: str, why: str) -> None:
    build(execute, {"arm.urdf": ELBOW_ARM})
    edit(FORE, (old, new))
    change = f"{old.partition(' = ')[2]} → {new.partition(' = ')[2]}"
    assert patch_and_told() == (b"", [f"{FORE}: inertial.mass {change}: stays, since {why}"])


def test_what_only_modelica_states_stays(repository: Repository, execute: Execute) -> None:
    build(execute, {"arm.urdf": ELBOW_ARM})
    edit("modelica/Arm/Arm.mo", ("\nequation", "\n  Real mine;\nequation"))
    edit(FORE, ("mass = 2.5", "mass = 3"), ("\n  annotation", "\n  // measured\n  Real more = 1;\n\n  annotation"))
    edit(ELBOW, ("within Arm.Joints;", "no model"))
    patch, told = patch_and_told()
    assert b'+    <inertial><mass value="3"/>' in patch
    assert told == [
        "modelica/Arm/Arm.mo: component `mine`: added: stays, since only numbers of records go into a patch",
        f"{ELBOW}: stays, since it is no single class without errors",
        f"{FORE}: comments: changed: stays, since only numbers of records go into a patch",
        f"{FORE}: more (none) → 1: stays, since no number of the source (arm.urdf:3) is this one: it is computed, "
        "or a default",
    ]


def test_a_change_of_both_sides_is_settled_first(repository: Repository, execute: Execute) -> None:
    """A build can't help; the named command can."""
    build(execute, {"arm.urdf": ELBOW_ARM})
    edit(FORE, ("mass = 2.5", "mass = 3"))
    edit("arm.urdf", ('value="2.5"', 'value="2.6"'))
    execute("build", code=3)
    reason = "the source has changed it, too: settle the conflict with `urdfsync resolve` first"
    assert patch_and_told() == (b"", [f"{FORE}: inertial.mass 2.5 → 3: stays, since {reason}"])
    execute("resolve", FORE, "--keep")
    assert patch_and_told()[0].count(b'+    <inertial><mass value="3"/>') == 1


# --- xacro --------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_literals_of_a_xacro(repository: Repository, execute: Execute) -> None:
    """They are in a YAML, in a macro of an included file, and in the configuration."""
    xacros.write(repository.folder)
    execute("build", "--quiet")
    edit(
        xacros.RECORD,
        ("mass = 1.5", "mass = 1.75"),
        ("{0.1, 0.1, 0.5}", "{0.1, 0.2, 0.7}"),
        ("izz = 0.1", "izz = 0.15"),
    )
    assert apply(repository, execute) == []
    assert Path("urdf/masses.yaml").read_text() == "upper: 1.75\n"
    assert Path("urdfsync.toml").read_text() == xacros.CONFIG.replace("0.5", "0.7")
    expected = xacros.BEAM.replace("0.1 0.1 $", "0.1 0.2 $").replace('izz="0.1"', 'izz="0.15"')
    assert Path("urdf/parts/beam.xacro").read_text() == expected


@pytest.mark.slow
def test_defaults_and_properties_of_nested_files(repository: Repository, execute: Execute) -> None:
    inner = f"{HEAD}<xacro:arg name='mass' default='2.5'/>\r\n<xacro:property name='m' value='$(arg mass)'/></robot>\n"
    files = {
        "arm.xacro": f"{HEAD}{INCLUDE.format('a/a')}{BASE}{CALL.format('w', '${m}')}</robot>",
        "a/a.xacro": f"{HEAD}{INCLUDE.format('b/b')}{WHEEL}</robot>\n",
        "a/b/b.xacro": inner,
    }
    build(execute, {**files}, CONFIG.replace("arm.urdf", "arm.xacro"))
    edit("modelica/Arm/Links/WParameters.mo", ("mass = 2.5", "mass = 3"))
    assert apply(repository, execute) == []
    assert Path("a/b/b.xacro").read_bytes().decode() == inner.replace("2.5", "3")


@pytest.mark.slow
def test_a_literal_that_feeds_two_parts_stays(repository: Repository, execute: Execute) -> None:
    calls = "".join(CALL.format(name, "${m}") for name in "ab")
    text = f'{HEAD}<xacro:property name="m" value="2.5"/>\n{WHEEL}{BASE}{calls}</robot>'
    build(execute, {"arm.xacro": text}, CONFIG.replace("arm.urdf", "arm.xacro"))
    records = [f"modelica/Arm/Links/{name}Parameters.mo" for name in "AB"]
    edit(records[0], ("mass = 2.5", "mass = 3"))
    why = "its number in arm.xacro:2 also feeds inertial.mass of link b"
    assert patch_and_told() == (b"", [f"{records[0]}: inertial.mass 2.5 → 3: stays, since {why}"])
    edit(records[1], ("mass = 2.5", "mass = 3"))  # both are edited: the literal feeds nothing else
    assert apply(repository, execute) == []
    assert Path("arm.xacro").read_text() == text.replace("2.5", "3")


@pytest.mark.slow
def test_two_edits_of_one_number_stay(repository: Repository, execute: Execute) -> None:
    calls = "".join(CALL.format(name, "${m}") for name in "ab")
    text = f'{HEAD}<xacro:property name="m" value="2.5"/>\n{WHEEL}{BASE}{calls}</robot>'
    build(execute, {"arm.xacro": text}, CONFIG.replace("arm.urdf", "arm.xacro"))
    edit("modelica/Arm/Links/AParameters.mo", ("mass = 2.5", "mass = 3"))
    edit("modelica/Arm/Links/BParameters.mo", ("mass = 2.5", "mass = 4"))
    patch, told = patch_and_told()
    assert (patch, len(told)) == (b"", 2)
    assert all(line.endswith("or another edit changes the same number") for line in told)


@pytest.mark.slow
def test_what_a_macro_leaves_out_is_inserted_for_one_part(repository: Repository, execute: Execute) -> None:
    one = f"{HEAD}{WHEEL}{BASE}{CALL.format('a', '2')}</robot>"
    build(execute, {"arm.xacro": one}, CONFIG.replace("arm.urdf", "arm.xacro"))
    edit("modelica/Arm/Joints/To_aParameters.mo", ("xyz = {0, 0, 0}", "xyz = {0, 0.5, 0}"))
    patch, told = patch_and_told()
    assert b'type="continuous"><origin xyz="0 0.5 0"/><parent ' in patch
    assert told == []
    Path("arm.xacro").write_text(one.replace("</robot>", f"{CALL.format('b', '2')}</robot>"))
    execute("build", "--quiet")
    patch, (line,) = patch_and_told()
    assert patch == b""
    assert line.endswith("its number in arm.xacro:6 also feeds origin.xyz of joint to_b")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("expression", "value", "why"),
    [
        ("${2*m}", 5, "no number of the source (arm.xacro:4) is this one: it is computed, or a default"),
        ("${m}", 2.5, "its number in arm.xacro:2 also feeds arm.xacro:5, arm.xacro:10"),
    ],
)
def test_an_expression_is_not_inverted(
    repository: Repository, execute: Execute, expression: str, value: float, why: str
) -> None:
    """A literal may also feed elements that no model has."""
    gazebo = '<gazebo reference="a"><mu2 value="${3*m}"/></gazebo>'
    parts = f"{BASE}{WHEEL}{CALL.format('a', expression)}{gazebo}"
    text = f'{HEAD}<xacro:property name="m" value="2.5"/>{parts}</robot>'
    build(execute, {"arm.xacro": text}, CONFIG.replace("arm.urdf", "arm.xacro"))
    record = "modelica/Arm/Links/AParameters.mo"
    edit(record, (f"mass = {value}", "mass = 6"))
    assert patch_and_told() == (b"", [f"{record}: inertial.mass {value} → 6: stays, since {why}"])


@pytest.mark.slow
def test_readings_do_not_grow_with_the_edits(
    repository: Repository, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A mass that also feeds an inertia stays, and names its own line alone; the positions of its joints go back."""
    wheel = WHEEL.replace('ixx="1"', 'ixx="${0.1*mass}"').replace('params="name mass"', 'params="name mass x"')
    wheel = wheel.replace("<axis", '<origin xyz="${x} 0 0"/><axis')
    calls = [CALL.format(f"w{n}", 2 + n / 8).replace("/>", f' x="{3 + n / 8}"/>') for n in range(6)]
    text = f"{HEAD}{wheel}{BASE}{''.join(calls)}</robot>"
    build(execute, {"arm.xacro": text}, CONFIG.replace("arm.urdf", "arm.xacro"))
    readings = list[int]()
    expand = expansion.expand

    def counted(*given: Any) -> Expansion:
        readings.append(1)
        return expand(*given)

    monkeypatch.setattr(expansion, "expand", counted)
    counts = list[int]()
    for number in range(6):
        edit(f"modelica/Arm/Links/W{number}Parameters.mo", (f"mass = {2 + number / 8:g},", "mass = 9,"))
        edit(f"modelica/Arm/Joints/To_w{number}Parameters.mo", (f"{{{3 + number / 8:g}, 0, 0}}", "{7, 0, 0}"))
        if number in (0, 5):
            readings.clear()
            patch, told = patch_and_told()
            counts.append(len(readings))
            assert patch.count(b"\n+<") == len(told) == number + 1
    assert counts == [3, 3]
    line = text[: text.index('name="w5"')].count("\n") + 1
    assert told[5].endswith(f"stays, since its number in arm.xacro:{line} also feeds inertial.inertia.ixx of link w5")


# --- places -------------------------------------------------------------------------------------------------------


def test_paths_begin_at_the_top_of_the_working_tree(
    repository: Repository, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    Path("robots/my arm").mkdir(parents=True)
    monkeypatch.chdir("robots/my arm")
    build(execute, {'ä "b".urdf': ELBOW_ARM}, CONFIG.replace('"arm.urdf"', "'ä \"b\".urdf'"))
    edit(FORE, ("mass = 2.5", "mass = 3"))
    patch, _ = patch_and_told()
    assert '--- "a/robots/my arm/ä \\"b\\".urdf"\n'.encode() in patch
    subprocess.run(["git", "apply"], input=patch, check=True)  # in a folder, git applies what is below
    assert 'value="3"' in Path('ä "b".urdf').read_text()


def test_without_a_repository_paths_begin_at_the_configuration(
    folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(folder.parent))
    build(execute, {"cad/arm.urdf": ELBOW_ARM.rstrip("\n")}, CONFIG.replace("arm.urdf", "cad/arm.urdf"))
    edit(FORE, ("mass = 2.5", "mass = 3"))
    edit(ELBOW, ("upper = 1,", "upper = 2,"))
    patch, _ = patch_and_told()
    assert b"--- a/cad/arm.urdf\n" in patch
    assert patch.endswith(b"\n </robot>\n\\ No newline at end of file\n")
    subprocess.run(["git", "apply"], input=patch, check=True)
    assert Path("cad/arm.urdf").read_text() == ELBOW_ARM.rstrip("\n").replace("2.5", "3").replace(
        'upper="1"', 'upper="2"'
    )


def test_a_file_outside_of_the_working_tree_stays(
    tmp_path: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    Repository(tmp_path / "project", monkeypatch)
    (tmp_path / "arm.urdf").write_text(ELBOW_ARM)
    monkeypatch.chdir(tmp_path / "project")
    build(execute, {}, CONFIG.replace("arm.urdf", "../arm.urdf"))
    edit(FORE, ("mass = 2.5", "mass = 3"))
    why = "its number is in ../arm.urdf, outside of ."
    assert patch_and_told() == (b"", [f"{FORE}: inertial.mass 2.5 → 3: stays, since {why}"])


def test_a_source_of_two_robots(repository: Repository, execute: Execute) -> None:
    other = CONFIG.replace("[robots.arm]", "[robots.second]").replace('"Arm"', '"Second"')
    build(execute, {"arm.urdf": ELBOW_ARM}, CONFIG + other)
    edit(FORE, ("mass = 2.5", "mass = 3"))
    why = "its number in arm.urdf:4 also feeds robot `second`"
    assert patch_and_told("arm") == (b"", [f"{FORE}: inertial.mass 2.5 → 3: stays, since {why}"])


def test_a_source_that_a_command_makes(repository: Repository, execute: Execute) -> None:
    copy = f"command = [{sys.executable!r}, '-c', 'import shutil; shutil.copy(\"in.urdf\", \"arm.urdf\")']\n"
    Path("in.urdf").write_text(ELBOW_ARM)
    Path("urdfsync.toml").write_text(f'{CONFIG}command_inputs = ["in.urdf"]\n{copy}')
    execute("build", "--quiet", "--trust")
    assert patch_and_told() == (b"", [])
    edit(FORE, ("mass = 2.5", "mass = 3"))
    patch, (line,) = patch_and_told(code=2)
    assert patch == b""
    assert "its source is made by a command, so no patch of it would last" in line


def test_a_link_to_a_source_is_followed(repository: Repository, execute: Execute) -> None:
    Path("cad").mkdir()
    Path("cad/real.urdf").write_text(ELBOW_ARM)
    os.symlink("cad/real.urdf", "arm.urdf")  # noqa: PTH211
    build(execute, {})
    edit(FORE, ("mass = 2.5", "mass = 3"))
    assert apply(repository, execute) == []
    assert Path("cad/real.urdf").read_text() == ELBOW_ARM.replace("2.5", "3")


# --- companions, other domains, arguments -------------------------------------------------------------------------


def test_a_cell_of_a_catalogue(repository: Repository, execute: Execute) -> None:
    config = f'{CONFIG}catalogue = "motors.csv"\nmotors = {{ elbow = "S" }}\n'
    rows = "name,effort [N.m],velocity [rpm]\r\nM,4.5,20\r\nS,4.5,30\r\n"
    build(execute, {"arm.urdf": ELBOW_ARM, "motors.csv": rows}, config)
    edit(ELBOW, ("effort = 4.5", "effort = 4.25"), ("velocity = 3.14159265358979", "velocity = 3.5"))
    patch, (line,) = patch_and_told()
    assert b"-S,4.5,30\r\n+S,4.25,30\r\n" in patch
    assert line.startswith(f"{ELBOW}: limits.velocity 3.14159265358979")


def test_positions_in_the_configuration(repository: Repository, execute: Execute) -> None:
    build(execute, {"arm.urdf": ELBOW_ARM}, CONFIG + "start = { elbow = 0.5 }\n")
    edit("modelica/Arm/ArmStart.mo", ("elbow = 0.5", "elbow = 0.25"))
    assert apply(repository, execute) == []
    assert Path("urdfsync.toml").read_text() == CONFIG + "start = { elbow = 0.25 }\n"


def test_cells_of_a_table(repository: Repository, execute: Execute) -> None:
    """A number goes back in the unit of its cell. Numbers of an arm with these motors stay."""
    shutil.copytree(Path(__file__).parents[2] / "formats/table/examples/servos", repository.folder, dirs_exist_ok=True)
    execute("build", "--quiet")
    record, joint = "modelica/Servos/Records/S41.mo", "modelica/Arm/Joints/ElbowParameters.mo"
    edit(joint, ("reduction = 353.5", "reduction = 360"))
    why = "its number in servos.csv:3 also feeds robot `servos`"
    assert patch_and_told() == (b"", [f"{joint}: transmission.reduction 353.5 → 360: stays, since {why}"])
    Path("urdfsync.toml").write_text(Path("urdfsync.toml").read_text().partition("[robots.arm]")[0])
    edit(record, ("= 353.5", "= 360"), ("= 4.1", "= 4.2"))
    patch, told = patch_and_told()
    assert b"\n-S41,410,46,353.5,0.6,20,0.05," in patch
    assert b"\n+S41,420,46,360,0.6,20,0.05," in patch
    assert told == []


@pytest.mark.parametrize(
    ("rows", "edits", "changed", "why"),
    [
        ("name,power [kW]\nA,3\nB,3\n", ("power = 3000", "3200"), "A,3.2\n", ""),
        ("name;power [kW];dp [bar]\nA;3,0;3,5\nB;1,5;4\n", ("power = 3000", "3200"), "A;3,2;3,5\n", ""),
        ("name;speed [km/h]\n3-B;100\n", ("speed = 27.77777777777778", "30"), "3-B;108\n", ""),
        ("name,speed [m/s]\nA,0\n", ("speed = 0", "2"), "A,2\n", ""),
        ("name,power [kW]\nA,0\n", ("power = 0", "200"), "A,0.2\n", ""),
        ("name,speed [rpm]\nA,30\n", ("speed = 3.141592653589793", "3.5"), "",
         "parts.csv:2 has it in another unit, in which 3.5 is no plain number"),
        ("name,t [degC]\nA,20\n", ("t = 293.15", "300"), "", "it is computed from the number in parts.csv:2"),
    ],
)  # fmt: skip
def test_units_of_cells(
    repository: Repository, execute: Execute, rows: str, edits: tuple[str, str], changed: str, why: str
) -> None:
    Path("parts.csv").write_text(rows)
    execute("init", "--domain", "table", "parts.csv", "--quiet")
    execute("build", "--quiet")
    record = next(iter(sorted(Path("modelica/Parts/Records").glob("*.mo"))))
    name, _, old = edits[0].partition(" = ")
    edit(str(record), (f" = {old}", f" = {edits[1]}"))
    if why:
        told = f"{record.as_posix()}: {name} {old} → {edits[1]}: stays, since {why}"
        assert patch_and_told() == (b"", [told])
    else:
        assert apply(repository, execute, ["parts: nothing is edited"]) == []
        assert changed in Path("parts.csv").read_text()


def test_angles_that_stand_in_degrees_stay(repository: Repository, execute: Execute) -> None:
    pytest.importorskip("mujoco")
    inertial = '<inertial pos="0.1 0 0" mass="1" diaginertia="0.01 0.02 0.02"/>'
    fore = f'<body name="fore" euler="0 30 0">\n<joint name="elbow" axis="0 1 0" range="-60 60"/>{inertial}</body>'
    body = f'<body name="upper">\n<joint name="shoulder" axis="0 1 0" range="-90 45"/>{inertial}\n{fore}</body>'
    model = f'<mujoco model="arm"><worldbody>{body}</worldbody></mujoco>'
    build(execute, {"arm.xml": model}, CONFIG.replace("arm.urdf", "arm.xml"))
    edit("modelica/Arm/Joints/ShoulderParameters.mo", ("lower = -1.5707963267948966", "lower = -1.5"))
    edit(ELBOW, ("{0, 0.523598775598299, 0}", "{0, 0.5, 0}"), ("upper = 1.0471975511965976", "upper = 1"))
    patch, told = patch_and_told()
    assert patch == b""
    assert [line.partition(" stays, since ")[2] for line in told] == [
        f"it is in degrees in arm.xml:{line}" for line in (3, 4, 2)
    ]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--patch"], "--patch writes a patch of what --edits shows; add --edits"),
        (["--edits", "--patch", "--format=markdown"], "--patch writes no document"),
        (["--edits", "--patch", "nowhere"], "no robot `nowhere` in the configuration"),
    ],
)
def test_arguments_that_do_not_fit(repository: Repository, execute: Execute, arguments: list[str], said: str) -> None:
    build(execute, {"arm.urdf": ELBOW_ARM})
    printed = execute("diff", *arguments, code=2)
    assert said in printed.words
