"""A project whose source is xacro: what is expanded, when, and what a clone needs."""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

import msgspec
import pytest
from support import xacros
from support.commands import Execute
from support.files import unchanged
from support.git import NEEDS_GIT, Repository
from support.meshes import stl
from support.remembered import save, saved
from support.replay import contents
from support.xacros import EXPANDED, RECORD

from urdfsync.common.dependencies import facts
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.engine.sources.source import Source
from urdfsync.project.state.expansion import dumps, loads

CHANGED = "inputs changed since the last build"


@pytest.fixture
def project(folder: Path) -> Path:
    xacros.write(folder)
    return folder


@pytest.fixture
def built(project: Path, execute: Execute) -> Path:
    execute("build")
    return project


def without_xacro(monkeypatch: pytest.MonkeyPatch, folder: Path) -> None:
    """Let processes that are started from now on find a xacro that can't be imported."""
    (folder / "broken").mkdir()
    (folder / "broken/xacro.py").write_text("raise ImportError('No module named xacro')\n")
    monkeypatch.setenv("PYTHONPATH", str(folder / "broken"))


LEGS = """\
  <xacro:property name="numbers" value="${xacro.load_yaml('$(find legs)/config/$(arg length).yaml')}"/>
  <xacro:include filename="$(find legs)/urdf/*.xacro"/>
  <xacro:macro name="pair" params="name:=leg *place **more turn:=${pi/2}">
    <xacro:if value="${numbers.get('mirrored', False)}">
      <xacro:leg name="${name}_mirrored" mass="${numbers['mass'] * turn}"><xacro:insert_block name="place"/></xacro:leg>
    </xacro:if>
    <xacro:leg name="${name}" mass="${numbers['mass']}"><xacro:insert_block name="place"/></xacro:leg>
    <xacro:insert_block name="more"/>
  </xacro:macro>
  <xacro:pair name="hind">
    <origin xyz="${-radians(30)} 0 ${sin(0.1)}" rpy="0 0 ${1/3}"/>
    <extra><gazebo reference="hind"><mu1>${0.1 + 0.2}</mu1></gazebo></extra>
  </xacro:pair>
  <xacro:unless value="$(arg bare)">
    <xacro:include filename="extra.xacro" optional="true"/>
    <transmission name="t"><joint name="to_hind"/><actuator name="m">
      <mechanicalReduction>${list(range(numbers['gear']))[-1]}</mechanicalReduction></actuator></transmission>
  </xacro:unless>
</robot>"""
LEG = """\
  <xacro:macro name="leg" params="name mass *at">
    <link name="${name}">
      <inertial><mass value="${mass}"/><inertia ixx="${mass/3}" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
      <visual><geometry><mesh filename="package://legs/mesh/leg.stl" scale="1e-3 ${1e-3} .001"/></geometry></visual>
    </link>
    <joint name="to_${name}" type="continuous">
      <xacro:insert_block name="at"/><parent link="base"/><child link="${name}"/>
    </joint>
  </xacro:macro>
</robot>"""
INDEX = """\
import os
def get_package_share_directory(name):
    return os.path.join(os.environ["AMENT_PREFIX_PATH"], "share", name)
"""
"""Where ROS 2 has its packages, in few words: xacro asks it for them."""


def test_the_package_is_that_of_ros_own_xacro(
    project: Path, tmp_path_factory: pytest.TempPathFactory, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Macros with blocks and defaults, includes by package and pattern, YAML, arguments, conditions and numbers."""
    prefix = tmp_path_factory.mktemp("install")
    for name, text in {
        "share/legs/package.xml": "<package><name>legs</name></package>",
        "share/legs/config/0.5.yaml": "mass: 1.1\ngear: 51\nmirrored: true\nangle: !degrees 30\n",
        "share/legs/urdf/leg.xacro": xacros.HEAD.format("leg") + LEG,
        "share/legs/mesh/leg.stl": stl(),
        "python/ament_index_python/packages.py": INDEX,
    }.items():
        (prefix / name).parent.mkdir(parents=True, exist_ok=True)
        (prefix / name).write_text(text)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(prefix))
    source = xacros.ARM.replace(
        '<xacro:arg name="length"', '<xacro:arg name="bare" default="0"/>\n<xacro:arg name="length"'
    )
    source = source.replace("</robot>", LEGS)
    settings = f'package = "Arm"\npackage_paths = ["{prefix}/share"]\n'
    xacros.write(project, {"arm.urdf.xacro": source}, xacros.CONFIG.replace('package = "Arm"\n', settings))
    execute("build")
    built = contents(project / "modelica")
    numbers = b"".join(text for name, text in built.items() if name.endswith("Parameters.mo"))
    assert all(text in numbers for text in (b"mass = 1.7278759594743864", b"mu = 0.30000000000000004", b"on = 50"))
    assert any(name.endswith(".stl") for name in built)
    command = [str(Path(sys.executable).with_name("xacro")), "urdf/arm.urdf.xacro", "length:=0.5"]
    environment = {**os.environ, "PYTHONPATH": str(prefix / "python")}
    expanded = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
    (project / "urdf/arm.urdf").write_text(expanded.stdout)
    (project / "urdfsync.toml").write_text(f'[robots.arm]\nsource = "urdf/arm.urdf"\n{settings}')
    shutil.rmtree(project / "modelica")
    shutil.rmtree(project / ".urdfsync")
    execute("build")
    assert contents(project / "modelica") == built


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("masses.yaml", "upper: 2.5\n"),
        ("parts/beam.xacro", xacros.BEAM.replace('mass value="${mass}"', 'mass value="${mass + 1}"')),
        ("arm.urdf.xacro", xacros.ARM.replace("masses['upper']", "masses['upper'] + 1")),
    ],
)
def test_each_file_is_an_input(built: Path, execute: Execute, name: str, text: str) -> None:
    assert "mass = 1.5" in Path(RECORD).read_text()
    (built / "urdf" / name).write_text(text)
    with unchanged(built):
        assert execute("status", code=1).lines[0] == "arm: out of step: 1 file to write"
        assert not execute("status", "--format=json", code=1).json["results"][0]["stale"]
        execute("build", "--check", code=1)
        execute("diff", code=1)
    execute("build")
    assert "mass = 2.5" in Path(RECORD).read_text()
    assert execute("status").lines == ["arm: in step, 15 files"]


def test_what_a_macro_says_twice_is_listed_once(project: Path, execute: Execute) -> None:
    lower = '  <xacro:beam name="lower" parent="upper" mass="1" length="1"/>\n</robot>'
    files = {
        "arm.urdf.xacro": xacros.ARM.replace("</robot>", lower),
        "parts/beam.xacro": xacros.BEAM.replace("<child", "<spring name='coil'/>\n      <spring/><child"),
    }
    xacros.write(project, files)
    warning, note = execute("build", "--format=json").json["results"][0]["diagnostics"]
    assert warning["code"] == "unknown-element"
    assert note["message"] == "not modelled: 4 <spring>"
    file = str(Path("urdf/parts/beam.xacro"))
    assert note["details"] == [
        {"line": 14, "text": "<spring> coil", "file": file},
        {"line": 15, "text": "<spring> joint to_upper", "file": file},
        {"line": 15, "text": "<spring> joint to_lower", "file": file},
    ]
    assert f"  {file}:15: <spring> joint to_lower" in execute("build", "--verbose").err


@pytest.mark.slow
def test_the_expansion_is_written_if_a_hash_changed_and_only_then(built: Path, execute: Execute) -> None:
    package, before = contents(built / "modelica"), EXPANDED.read_bytes()
    (built / "urdf/parts/other.xacro").write_text("nobody reads this")
    (built / "urdf/masses.yaml").write_text("upper: 1.5\r\n", newline="")
    (built / "urdf/arm.urdf.xacro").touch()
    for command in (["build"], ["build", "--full"]):
        execute(*command)
        assert EXPANDED.read_bytes() == before
    (built / "urdf/masses.yaml").write_text("upper: 1.50\n")
    assert execute("status").lines == ["arm: in step, 15 files"]
    assert "recorded state renewed" in execute("build").out
    after = EXPANDED.read_bytes()
    assert after != before
    assert after.partition(b"<?xml")[2] == before.partition(b"<?xml")[2]
    assert contents(built / "modelica") == package
    execute("build")
    assert EXPANDED.read_bytes() == after


def test_line_ends_are_no_change(built: Path, execute: Execute) -> None:
    for path in (built / "urdf").rglob("*.*"):
        path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    assert execute("status").lines == ["arm: in step, 15 files"]


@pytest.mark.slow
def test_arguments_and_variables_are_inputs(project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    text = xacros.ARM.replace('default="0.5"', 'default="$(optenv LONG 2)"')
    xacros.write(project, {"arm.urdf.xacro": text}, xacros.CONFIG.replace("arguments = { length = 0.5 }\n", ""))
    execute("build")
    assert "boxSize" not in execute("status").out
    monkeypatch.setenv("LONG", "3")
    assert "size[2] 2 → 3 m" in execute("status", code=1).out
    execute("build")
    (project / "urdfsync.toml").write_text(xacros.CONFIG.replace("0.5", "0.75"))
    assert "size[2] 3 → 0.75 m" in execute("status", code=1).out


def test_a_variable_is_a_dependency(project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(facts, "YOUNG", 50_000_000)
    files = {"arm.urdf.xacro": xacros.ARM.replace('default="0.5"', 'default="$(optenv LONG 2)"')}
    xacros.write(project, files, xacros.CONFIG.replace("arguments = { length = 0.5 }\n", ""))
    execute("build")
    save("build")
    assert saved("build") is not None
    monkeypatch.setenv("LONG", "3")
    assert saved("build") is None


@pytest.mark.slow
def test_each_input_is_a_dependency(built: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(facts, "YOUNG", 50_000_000)
    for name in ("masses.yaml", "parts/beam.xacro", "arm.urdf.xacro"):
        save("build")
        assert saved("build") is not None
        with (built / "urdf" / name).open("a") as file:
            file.write("\n")
        assert saved("build") is None, name


def test_a_clone_needs_no_xacro(built: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.rmtree(built / "modelica")
    shutil.rmtree(built / ".urdfsync/notes")
    without_xacro(monkeypatch, built)
    execute("build")
    for command in ("build", "status", "build --check"):
        printed = execute(*command.split())
        assert printed.lines == ["arm: in step, 15 files"]
    assert "recorded source is used, unchecked: xacro can't be loaded" in execute("build", "--check", "--verbose").err
    (built / "urdf/masses.yaml").write_text("upper: 2\n")
    assert "pip install xacro [not-installed]" in execute("status", code=2).err
    assert "pip install xacro [not-installed]" in execute("build", code=2).err
    assert "1.5" in Path(RECORD).read_text()


@pytest.mark.slow
def test_a_package_that_is_not_here_counts_as_unchanged(
    project: Path, tmp_path_factory: pytest.TempPathFactory, execute: Execute
) -> None:
    elsewhere = tmp_path_factory.mktemp("ros")
    (elsewhere / "beams").mkdir()
    (elsewhere / "beams/package.xml").write_text("<package><name>beams</name></package>")
    (elsewhere / "beams/beam.xacro").write_text(xacros.BEAM)
    files = {"arm.urdf.xacro": xacros.ARM.replace("parts/beam.xacro", "$(find beams)/beam.xacro")}
    xacros.write(project, files, f'{xacros.CONFIG}package_paths = ["{elsewhere}"]\n')
    execute("build")
    assert '"package://beams/beam.xacro"' in EXPANDED.read_text()
    assert str(elsewhere) not in EXPANDED.read_text()
    (elsewhere / "beams/beam.xacro").write_text(xacros.BEAM.replace("0.1 0.1", "0.2 0.2"))
    assert "size[0, 1] (0.1, 0.1) → (0.2, 0.2) m" in execute("status", code=1).out
    shutil.rmtree(elsewhere)
    (project / "urdfsync.toml").write_text(xacros.CONFIG)
    assert execute("status").lines == ["arm: in step, 15 files"]
    shutil.rmtree(project / ".urdfsync/notes")
    printed = execute("build", "--check", "--verbose")
    assert "recorded source is used, unchecked: package://beams/beam.xacro is not on this machine" in printed.err


def test_a_recorded_text_that_xacro_does_not_give_is_out_of_step(built: Path, execute: Execute) -> None:
    """The state may be a stranger's: neither its text nor its hashes prove anything, and no file that it names."""
    made = loads(EXPANDED.read_bytes())
    assert made is not None
    text = made.text.replace('mass value="1.5"', 'mass value="9"')
    for files in ({}, {"package://nowhere/a.xacro": "0" * 64}):
        EXPANDED.write_bytes(dumps(msgspec.structs.replace(made, text=text, files={**made.files, **files})))
        assert execute("status").lines == ["arm: in step, 15 files"]


def test_packages_of_ros_2_are_found(
    project: Path, tmp_path_factory: pytest.TempPathFactory, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    prefix = tmp_path_factory.mktemp("install")
    (prefix / "share/beams").mkdir(parents=True)
    (prefix / "share/beams/package.xml").write_text("<package><name>beams</name></package>")
    (prefix / "share/beams/beam.xacro").write_text(
        xacros.BEAM.replace('<box size="0.1 0.1 ${length}"/>', '<mesh filename="file://$(find beams)/a.stl"/>')
    )
    xacros.write(project, {"arm.urdf.xacro": xacros.ARM.replace("parts/beam.xacro", "$(find beams)/beam.xacro")})
    execute("build", code=2)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(prefix))
    execute("build")
    assert 'filename="package://beams/a.stl"' in EXPANDED.read_text()


def test_files_that_match_a_pattern_are_inputs(project: Path, execute: Execute) -> None:
    xacros.write(project, {"arm.urdf.xacro": xacros.ARM.replace("parts/beam.xacro", "parts/*.xacro")})
    execute("build")
    (project / "urdf/parts/more.xacro").write_text(f'{xacros.HEAD.format("more")}<link name="more"/></robot>')
    assert "2 links have no parent: 'more', 'base'" in execute("status", code=2).err


def test_an_optional_file_that_appears_is_an_input(project: Path, execute: Execute) -> None:
    more = '<xacro:include filename="more.xacro" optional="true"/>\n</robot>'
    xacros.write(project, {"arm.urdf.xacro": xacros.ARM.replace("</robot>", more)})
    execute("build")
    (project / "urdf/more.xacro").write_text(f"{xacros.HEAD.format('more')}<link name='more'/></robot>")
    assert "2 links have no parent: 'base', 'more'" in execute("status", code=2).err


@pytest.mark.parametrize("damage", ["<<<<<<< ours\n{}", "{}\n</robot>", "no JSON"])
def test_a_damaged_expansion_is_none(built: Path, execute: Execute, damage: str) -> None:
    text = EXPANDED.read_text()
    EXPANDED.write_text(damage.format(text))
    execute("build")
    assert EXPANDED.read_text() == text


def test_an_expansion_of_a_stranger_is_only_compared(built: Path, execute: Execute) -> None:
    own = loads(EXPANDED.read_bytes())
    assert own is not None
    files = {
        "a\0b": "1",
        "/dev/zero": "1",
        "package://../../etc/passwd": "1",
        "package://a\0b/c": "1",
        "a" * 9999: "1",
        "\x1b[31mred": "1",
    }
    odd = msgspec.structs.replace(own, files={**own.files, **files}, places="x=1:2 7", variables={"a=b": "1", "": "1"})
    EXPANDED.write_bytes(dumps(odd))
    with unchanged(built):
        said = execute("status", "-v").out
    assert "\x1b" not in said
    execute("build")
    assert EXPANDED.read_bytes() == dumps(own)


@pytest.mark.slow
def test_a_pattern_of_a_stranger_is_none_of_folders(built: Path, execute: Execute) -> None:
    own = loads(EXPANDED.read_bytes())
    assert own is not None
    for name in ("a", "b"):
        (built / name).symlink_to(".")
    patterns = ["*/" * 30 + "x", "/*/*/*/*/*/*", "**/*", "a\0b/*", "/dev/zero/*", "/proc/self/fd/*"]
    EXPANDED.write_bytes(dumps(msgspec.structs.replace(own, patterns=dict.fromkeys(patterns, "1"))))
    begin = time.monotonic()
    execute("status")
    execute("build", "--check")
    assert time.monotonic() - begin < 30
    execute("build")
    assert EXPANDED.read_bytes() == dumps(own)


def test_what_is_wrong_is_told_at_its_place_in_xacro(project: Path, execute: Execute) -> None:
    xacros.write(project, {"parts/beam.xacro": xacros.BEAM.replace('"${mass}"', '"-${mass}"')})
    line = 1 + xacros.BEAM[: xacros.BEAM.index("<mass")].count("\n")
    for _ in range(2):
        assert f"urdf/parts/beam.xacro:{line}: error:" in execute("build", code=2).err


def test_a_warning_is_told_at_its_place_by_each_build(project: Path, execute: Execute) -> None:
    colour = '<material name="red"><color rgba="255 0 0 1"/></material></visual>'
    xacros.write(project, {"parts/beam.xacro": xacros.BEAM.replace("</visual>", colour)})
    line = 1 + xacros.BEAM[: xacros.BEAM.index("</visual")].count("\n")
    for options in ([], ["--verbose"]):
        assert f"urdf/parts/beam.xacro:{line}: warning:" in execute("build", *options).err


def test_lines_in_messages_are_those_of_xacro(project: Path, execute: Execute) -> None:
    colour = '<material name="${name}"><color rgba="255 0 0 1"/></material></visual>'
    beams = "".join(f'<xacro:beam name="beam{n}" parent="base" mass="1" length="1"/>\n' for n in range(5))
    files = {"parts/beam.xacro": xacros.BEAM.replace("</visual>", colour)}
    xacros.write(project, files | {"arm.urdf.xacro": xacros.ARM.replace("</robot>", f"{beams}</robot>")})
    line = 1 + xacros.BEAM[: xacros.BEAM.index("</visual")].count("\n")
    words = execute("build").words
    assert f"urdf/parts/beam.xacro:{line}: warning: " in words
    assert f"(and 5 more like it: line {line})" in words


def test_lines_in_another_file_are_told_with_it(project: Path, execute: Execute) -> None:
    gears = "".join(f'  <gazebo reference="gear{n}"><mu1>1</mu1></gazebo>\n' for n in range(3))
    beam = xacros.BEAM.replace("  </xacro:macro>", f"{gears}  </xacro:macro>")
    pinion = '  <gazebo reference="pinion"><mu1>1</mu1></gazebo>\n'
    arm = xacros.ARM.replace('  <link name="base"/>', f'{pinion}  <link name="base"/>')
    xacros.write(project, {"arm.urdf.xacro": arm, "parts/beam.xacro": beam})
    first = 1 + beam[: beam.index("<gazebo")].count("\n")
    places = ", ".join(f"urdf/parts/beam.xacro:{first + n}" for n in range(3))
    words = execute("build").words
    assert "urdf/arm.urdf.xacro:5: warning: <gazebo> refers to 'pinion'" in words
    assert f"(and 3 more like it: lines {places})" in words


def test_lines_of_other_files_in_a_message_stay(project: Path, execute: Execute) -> None:
    """The reader of a mesh names lines of the mesh."""
    mesh = '<visual><geometry><mesh filename="bad.dae"/></geometry></visual>'
    beam = xacros.BEAM.replace("<visual>", f"{mesh}\n      <visual>")
    xacros.write(project, {"parts/beam.xacro": beam, "bad.dae": "<a>\n" * 7})
    (told,) = [line for line in execute("build").err.splitlines() if "can't be read" in line]
    assert told.startswith("urdf/parts/beam.xacro:")
    assert "Premature end of data in tag a line 7," in told


def test_what_xacro_says_and_arguments_that_it_does_not_have(project: Path, execute: Execute) -> None:
    said = "${xacro.warning('mind the step')}${xacro.message('go on')}</robot>"
    said = xacros.ARM.replace("</robot>", said)
    xacros.write(project, {"arm.urdf.xacro": said}, xacros.CONFIG.replace("{ length", "{ lenght = 1, length"))
    for options in ([], ["--verbose"]):
        words = execute("build", *options).words
        assert "urdf/arm.urdf.xacro: warning: mind the step [xacro-said]" in words
        assert "urdf/arm.urdf.xacro: note: go on [xacro-said]" in words
        assert "urdfsync.toml:3: warning: robot `arm`: the source has no argument `lenght`" in words


def test_sources_of_no_robot_are_warned_about_too(project: Path, execute: Execute) -> None:
    said = xacros.ARM.replace("</robot>", "${xacro.warning('mind the step')}</robot>")
    xacros.write(project, {"arm.urdf.xacro": said, "other.urdf.xacro": said})
    for command in (["record", "-o", "Arm.mo"], ["add"]):
        words = execute(*command, "urdf/other.urdf.xacro", "lenght:=1").words
        assert "urdf/other.urdf.xacro: warning: mind the step [xacro-said]" in words
        assert "urdf/other.urdf.xacro: warning: the source has no argument `lenght`; correct its name" in words
    (project / "urdf/other.urdf.xacro").write_text(xacros.ARM)
    words = execute("diff", "urdf/arm.urdf.xacro", "--against", "urdf/other.urdf.xacro").words
    assert "urdf/arm.urdf.xacro: warning: mind the step [xacro-said]" in words


@pytest.mark.slow
@NEEDS_GIT
def test_branches_unite_without_a_conflict(built: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    repository = Repository(built, monkeypatch)
    repository.commit()
    repository.git("checkout", "-qb", "other")
    (built / "urdf/masses.yaml").write_text("upper: 2\n")
    execute("build")
    repository.commit()
    repository.git("checkout", "-q", "-")
    (built / "urdf/parts/beam.xacro").write_text(xacros.BEAM.replace("0.1 0.1", "0.3 0.3"))
    execute("build")
    repository.commit()
    with contextlib.suppress(subprocess.CalledProcessError):  # of a record that both exported, the stamp conflicts
        repository.git("merge", "-q", "other")
    execute("build")
    repository.git("add", "-A")
    assert "mass = 2" in Path(RECORD).read_text()
    assert execute("status").lines == ["arm: in step, 15 files"]


@pytest.mark.slow
@NEEDS_GIT
def test_a_revision_is_compared_as_it_was_expanded(
    built: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    repository = Repository(built, monkeypatch)
    repository.commit()
    (built / "urdf/masses.yaml").write_text("upper: 2.5\n")
    assert "1.5 → 2.5 kg" in execute("diff", "arm", "--against", "HEAD", code=1).out
    assert "1.5 → 2.5 kg" in execute("diff", "urdf/arm.urdf.xacro", code=1).out
    execute("build")
    without_xacro(monkeypatch, built)  # it is expanded already
    assert "1.5 → 2.5 kg" in execute("diff", "arm", "--against", "HEAD", code=1).out
    repository.git("rm", "-q", "--cached", str(EXPANDED))
    repository.git("commit", "-q", "-m", "without the expansion")
    unknown = "HEAD:urdf/arm.urdf.xacro: error: its expansion is not recorded; name a revision with a complete build"
    for source in ("arm", "urdf/arm.urdf.xacro"):
        assert unknown in execute("diff", source, "--against", "HEAD", code=2).err


@NEEDS_GIT
@pytest.mark.slow
def test_an_old_warning_of_xacro_is_not_new(built: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    config = built / "urdfsync.toml"
    config.write_text(config.read_text().replace("length = 0.5", "length = 0.5, width = 1"))
    assert "the source has no argument `width`" in execute("build").words
    Repository(built, monkeypatch).commit()
    (built / "urdf/masses.yaml").write_text("upper: 2.5\n")
    assert execute("diff", "arm", "--against", "HEAD", code=1).err == ""


@NEEDS_GIT
@pytest.mark.slow
def test_a_hook_asks_for_every_input(built: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    repository = Repository(built, monkeypatch)
    repository.commit()
    (built / "urdf/masses.yaml").write_text("upper: 2.5\n")
    execute("build")
    repository.git("add", "modelica", ".urdfsync")
    assert "git add :/urdf/masses.yaml" in execute("hook", "check", code=1).err
    repository.git("add", "urdf")
    repository.git("reset", "-q", str(EXPANDED))
    execute("hook", "check")  # a clone expands the source again
    repository.git("add", ".urdfsync")
    execute("hook", "check")
    (built / "urdf/masses.yaml").write_text("upper: 2.5 # kg\n")
    repository.git("add", "urdf")
    execute("hook", "check")  # nothing in the package is other than it should be


def test_remove_takes_the_expanded_source_away(built: Path, execute: Execute) -> None:
    execute("remove", "arm", "--yes")
    assert not EXPANDED.exists()


def test_a_robot_of_another_name_takes_its_expansion_along(
    built: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    without_xacro(monkeypatch, built)
    (built / "urdfsync.toml").write_text(xacros.CONFIG.replace("robots.arm", "robots.leg"))
    execute("build")
    assert not EXPANDED.exists()
    assert execute("status").lines == ["leg: in step, 15 files"]


@pytest.mark.slow
def test_xacro_is_noticed_whatever_its_name(project: Path, execute: Execute) -> None:
    (project / "urdf/arm.urdf.xacro").rename(project / "urdf/arm.urdf")
    (project / "urdfsync.toml").unlink()
    execute("init", "urdf/arm.urdf", "length:=0.75")
    assert 'arguments = { length = "0.75" }' in (project / "urdfsync.toml").read_text()
    shutil.copy("urdf/arm.urdf", "urdf/second.urdf")
    execute("add", "urdf/second.urdf")
    execute("build")
    assert "0.75" in EXPANDED.read_text()
    assert "0.5" in EXPANDED.with_name("second.expanded").read_text()
    assert "nothing changed" in execute("diff", "urdf/second.urdf", "--against", "urdf/arm.urdf").out
    assert "0.25" in execute("record", "urdf/arm.urdf", "length:=0.25").out
    (project / "urdf/masses.yaml").write_text("upper: 2.5\n")
    assert execute("status", "second", code=1).lines[0] == "second: out of step: 1 file to write"


@pytest.mark.parametrize(
    "line",
    [
        "<!-- <xacro:macro name='leg'/> ${mass} -->",
        '<xacro:include filename="$(find gone)/colors.xacro"/>',
        '<gazebo reference="base"><xacro:grey/></gazebo>',
    ],
)
def test_an_expanded_urdf_may_have_leftovers_of_xacro(folder: Path, execute: Execute, line: str) -> None:
    (folder / "arm.urdf").write_text(f'{xacros.HEAD.format("arm")}{line}\n<link name="base"/>\n</robot>')
    execute("init", "arm.urdf")
    execute("build")
    assert not EXPANDED.exists()
    assert "arm.urdf is no xacro" in execute("record", "arm.urdf", "a:=1", code=2).err


def test_a_robot_that_is_xacro_no_more(built: Path, execute: Execute) -> None:
    (built / "urdf/arm.urdf").write_text('<robot name="arm"><link name="base"/></robot>')
    (built / "urdfsync.toml").write_text('[robots.arm]\nsource = "urdf/arm.urdf"\npackage = "Arm"\n')
    execute("build")
    assert not EXPANDED.exists()


@pytest.mark.slow
def test_init_and_add_and_record(project: Path, execute: Execute) -> None:
    (project / "urdfsync.toml").unlink()
    execute("init", "urdf/arm.urdf.xacro", "length:=0.75")
    assert 'arguments = { length = "0.75" }' in (project / "urdfsync.toml").read_text()
    execute("build")
    execute("add", "urdf/arm.urdf.xacro", "length:=0.75", code=2)
    shutil.copy("urdf/arm.urdf.xacro", "urdf/second.urdf.xacro")
    execute("add", "urdf/second.urdf.xacro", "name:=second")
    execute("build")
    assert "0.75" in execute("record", "urdf/arm.urdf.xacro", "length:=0.75").out
    (project / "urdf/plain.urdf").write_text('<robot name="plain"><link name="base"/></robot>')
    assert "is an argument of xacro" in execute("record", "urdf/plain.urdf", "length:=0.75", code=2).err
    assert "can't be read" in execute("record", "urdf/gone.urdf", "length:=0.75", code=2).err


@pytest.mark.slow
def test_the_daemon_sees_each_input(built: Path) -> None:
    from support.daemon import Watch  # watchdog takes 45 ms

    with Watch(built, "--settle", "20", "--rescan", "100000") as watch:
        watch.rest()
        for name, text, mass in [
            ("masses.yaml", "upper: 2.5\n", 2.5),
            ("parts/beam.xacro", xacros.BEAM.replace('mass value="${mass}"', 'mass value="${mass + 1}"'), 3.5),
            ("arm.urdf.xacro", xacros.ARM.replace("masses['upper']", "masses['upper'] + 1"), 4.5),
        ]:
            since = watch.mark
            (built / "urdf" / name).write_text(text)
            watch.wait("built", since=since)
            assert f"mass = {mass}" in Path(RECORD).read_text()
        since = watch.mark
        (built / "urdf/masses.yaml").write_text("upper: [1\n")
        waiting = watch.wait("waiting", since=since)
        assert [(found["file"], found["line"]) for found in waiting["diagnostics"]] == [("urdf/masses.yaml", 2)]
        (built / "urdf/masses.yaml").write_text("upper: 1.25\n")
        watch.wait("built", since=since)
        assert "mass = 3.25" in Path(RECORD).read_text()


@pytest.mark.slow
def test_the_daemon_sees_a_file_that_was_wrong_from_the_beginning(project: Path) -> None:
    from support.daemon import Watch

    xacros.write(project, {"masses.yaml": "upper: [1\n"})
    with Watch(project, "--settle", "20", "--rescan", "100000") as watch:
        watch.wait("waiting")
        (project / "urdf/masses.yaml").write_text("upper: 2.5\n")
        watch.wait("built")
        assert "mass = 2.5" in Path(RECORD).read_text()


@pytest.mark.slow
def test_the_daemon_waits_for_files_that_are_not_there(project: Path) -> None:
    from support.daemon import Watch

    def include(name: str) -> str:
        return xacros.ARM.replace("parts/beam.xacro", name)

    beam = xacros.BEAM.replace('mass value="${mass}"', 'mass value="{0}"')
    source = project / "urdf/arm.urdf.xacro"
    source.write_text(include("later/deep/beam.xacro"))
    with Watch(project, "--settle", "20", "--rescan", "100000") as watch:
        watch.wait("waiting")
        for place, name in [
            ("urdf/later/deep/beam.xacro", "later/deep/beam.xacro"),
            ("urdf/more/beam.xacro", "more/*.xacro"),
            ("urdf/more/other.xacro", "more/*.xacro"),
            ("beams/beam.xacro", "$(find beams)/beam.xacro"),
        ]:
            mass = str(len(place))
            if source.read_text() != include(name):
                since = watch.mark
                source.write_text(include(name))
                watch.wait("waiting", since=since)
            since = watch.mark
            (project / place).parent.mkdir(parents=True, exist_ok=True)
            if name.startswith("$"):
                (project / "beams/package.xml").write_text("<package><name>beams</name></package>")
            (project / place).write_text(beam.replace("{0}", mass))
            watch.wait("built", since=since)
            assert f"mass = {mass}" in Path(RECORD).read_text()


@pytest.mark.slow
def test_a_file_that_comes_ends_a_failure(project: Path, execute: Execute) -> None:
    (project / "urdf/masses.yaml").rename(project / "urdf/later.yaml")
    for _ in range(2):
        assert "masses.yaml can't be read" in execute("build", code=2).words
        execute("status", code=2)
    (project / "urdf/later.yaml").rename(project / "urdf/masses.yaml")
    execute("build")
    assert execute("status").lines == ["arm: in step, 15 files"]


COMMAND = """
import pathlib, sys
numbers = pathlib.Path("mass.txt").read_text()
if numbers == "bad":
    sys.exit("no such mass")
pathlib.Path("runs.txt").open("a").write("once\\n")
pathlib.Path("arm.urdf").write_text(f'''<robot name="arm"><link name="base"><inertial><mass value="{numbers}"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link></robot>''')
"""


@pytest.fixture
def commanded(folder: Path) -> Path:
    """A project whose source a command writes."""
    (folder / "make.py").write_text(COMMAND)
    (folder / "mass.txt").write_text("1.5")
    command = json.dumps([sys.executable, "make.py"])
    text = f'[robots.arm]\nsource = "arm.urdf"\ncommand = {command}\ncommand_inputs = ["mass.txt"]\npackage = "Arm"\n'
    (folder / "urdfsync.toml").write_text(text)
    return folder


def test_a_command_is_run_only_with_the_users_word(
    commanded: Path, execute: Execute, tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    with unchanged(commanded):
        printed = execute("build", code=2).words
        assert "urdfsync.toml:3: error: robot `arm`: its `command` was not run" in printed
        assert "[untrusted-command]" in printed
        assert execute("status", code=1).lines[:2] == [
            "arm: not expanded, so its files were not compared",
            "  no expansion is recorded",
        ]
    home = tmp_path_factory.mktemp("home")
    monkeypatch.setenv("XDG_CONFIG_HOME", str(home))
    (home / "urdfsync").mkdir()
    (home / "urdfsync/trusted.toml").write_text(f"folders = {json.dumps([str(commanded)])}\n")
    execute("build")
    assert (commanded / "runs.txt").read_text() == "once\n"


def test_a_command_runs_when_its_inputs_change(commanded: Path, execute: Execute) -> None:
    execute("build", "--trust")
    record = commanded / "modelica/Arm/Links/BaseParameters.mo"
    assert execute("build").lines == execute("status").lines == ["arm: in step, 9 files"]  # which asks for no trust
    (commanded / "mass.txt").write_text("2.5")
    with unchanged(commanded):
        assert execute("status", code=1).lines == [f"arm: {CHANGED}", "  mass.txt"]
        assert execute("build", "--check", code=1).lines == [f"arm: {CHANGED}"]
    execute("build", "--trust")
    assert "mass = 2.5" in record.read_text()
    assert (commanded / "runs.txt").read_text() == "once\n" * 2
    (commanded / "arm.urdf").write_text((commanded / "arm.urdf").read_text().replace("2.5", "3.5"))  # by hand
    execute("build")
    assert "mass = 3.5" in record.read_text()
    (commanded / "mass.txt").write_text("bad")
    with unchanged(commanded):
        found = execute("build", "--trust", code=2).words
        assert "urdfsync.toml:3: error: robot `arm`: the command" in found
        assert "failed: exit code 1: no such mass" in found


def test_a_command_that_writes_no_source_has_failed(commanded: Path, execute: Execute) -> None:
    (commanded / "make.py").write_text("")
    assert "failed: it did not write arm.urdf; correct it" in execute("build", "--trust", code=2).words


@pytest.mark.parametrize(("line", "place"), [(1, ("root.xacro", 1)), (4, ("root.xacro", 1)), (5, ("part.xacro", 9))])
def test_a_line_of_an_expansion_is_located_where_its_element_begins(line: int, place: tuple[str, int]) -> None:
    expanded = Source(b"", "arm.urdf", places=[(3, "root.xacro", 1), (5, "part.xacro", 9)])
    located = expanded.locate(Diagnostic(Severity.ERROR, "code", f"see line {line}", "arm.urdf", line))
    assert (located.file, located.line) == place
    other = Diagnostic(Severity.ERROR, "code", "words", "urdfsync.toml", line)
    assert expanded.locate(other) is other
