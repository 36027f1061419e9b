"""`urdfsync diff` of files and revisions, and of much at once; `tests/scenarios/diff.txt` has the last build."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from support.commands import Execute
from support.files import unchanged
from support.git import NEEDS_GIT, Repository
from support.meshes import stl
from support.networks import add_resistor, edit

from urdfsync.engine.result import Exit

ARM = """<robot name="arm">
  <link name="base"/>
  <link name="tip">
    <inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><geometry><mesh filename="tip.stl"/></geometry></visual>
  </link>
  <joint name="elbow" type="revolute">
    <parent link="base"/><child link="tip"/><limit lower="-1" upper="1" effort="54" velocity="2"/>
  </joint>
</robot>
"""


@pytest.fixture
def arm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder, also the working one, with an arm, its mesh and a changed version, and without a configuration."""
    folder = tmp_path / "arm"
    folder.mkdir()
    (folder / "tip.stl").write_text(stl(1))
    (folder / "arm.urdf").write_text(ARM)
    (folder / "new.urdf").write_text(
        ARM.replace('effort="54"', 'effort="60"').replace('mass value="2"', 'mass value="3"')
    )
    monkeypatch.chdir(folder)
    return folder


def said(execute: Execute, *arguments: str) -> tuple[int, list[str]]:
    """Exit code and output of a command that has nothing to complain about."""
    printed = execute("diff", *arguments, code=None)
    assert printed.err == ""
    return printed.code, printed.lines


def test_a_file_with_a_loop_is_compared(arm: Path, execute: Execute) -> None:
    new = arm / "new.urdf"
    loop = '<loop_joint name="bar" type="prismatic"><link1 link="a"/><link2 link="b"/></loop_joint>'
    new.write_text(new.read_text().replace("</robot>", f"{loop}</robot>"))
    printed = execute("diff", "new.urdf", "--against", "arm.urdf", code=1)
    assert "54 → 60" in printed.out
    assert "warning: loop bar has type='prismatic', which is no kind of loop" in printed.words


def refused(execute: Execute, *arguments: str) -> str:
    """The only complaint of a command, which exits with 2."""
    printed = execute("diff", *arguments, code=2)
    assert printed.out == ""
    *before, complaint = printed.errors
    assert all(line.endswith("so nothing can be compared") for line in before)
    return complaint


# another file


def test_two_files_without_a_configuration(arm: Path, execute: Execute) -> None:
    with unchanged(arm):
        assert said(execute, "new.urdf", "--against", "arm.urdf") == (
            1,
            [
                "new.urdf: ~2 (2 parameter changes) since arm.urdf",
                "  link tip: inertial / mass 2 → 3 kg (+50 %)",
                "  joint elbow: limit / effort 54 → 60 N·m (+11.1 %)",
                "",
                "Effects",
                "  robot mass 2 → 3 kg (+50 %)",
                "",
                "2 files of the package differ",
                "  changed    Joints/ElbowParameters.mo",
                "  changed    Links/TipParameters.mo",
            ],
        )
        assert said(execute, "arm.urdf", "--against", str(arm / "arm.urdf"))[0] == 0


def test_a_file_from_another_folder_finds_its_meshes_beside_the_source(arm: Path, execute: Execute) -> None:
    (arm / "old").mkdir()
    shutil.copy(arm / "arm.urdf", arm / "old")
    assert said(execute, "arm.urdf", "--against", "old/arm.urdf") == (
        0,
        ["arm.urdf: nothing changed since old/arm.urdf"],
    )
    (arm / "old/tip.stl").write_text(stl(2))
    code, lines = said(execute, "arm.urdf", "--against", "old/arm.urdf")
    assert code == 1
    assert lines[1].startswith("  mesh tip.stl: content ")
    assert any(line.startswith("  changed    Resources") for line in lines)


# a revision


@NEEDS_GIT
def test_a_revision_with_the_mesh_as_it_was(arm: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    repository = Repository(arm, monkeypatch)
    repository.commit()
    assert said(execute, "arm.urdf", "--against", "HEAD") == (0, ["arm.urdf: nothing changed since HEAD"])
    (arm / "tip.stl").write_text(stl(2))
    edit("arm.urdf", 'effort="54"', 'effort="60"')
    code, lines = said(execute, "arm.urdf", "--against", "HEAD")
    assert code == 1
    assert [line.partition(":")[0] for line in lines[1:3]] == ["  joint elbow", "  mesh tip.stl"]
    repository.commit()
    assert said(execute, "arm.urdf", "--against", "HEAD")[0] == 0


@pytest.mark.slow
@NEEDS_GIT
def test_a_revision_comes_before_a_file_of_its_name(
    arm: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A pull request may bring such a file, as it is itself: then nothing would seem to have changed."""
    repository = Repository(arm, monkeypatch)
    repository.commit()
    repository.git("update-ref", "refs/remotes/origin/main", "main")
    edit("arm.urdf", 'effort="54"', 'effort="60"')
    (arm / "origin").mkdir()
    for name in ("HEAD", "origin/main", "old.urdf"):
        shutil.copy("arm.urdf", name)
    for name, code in (("HEAD", 1), ("origin/main", 1), ("./HEAD", 0), (str(arm / "origin/main"), 0), ("old.urdf", 0)):
        assert said(execute, "arm.urdf", "--against", name)[0] == code, name
    (arm / "urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    assert execute("report", "--against", "HEAD").lines[0] == "arm: 1 parameter change since HEAD"
    assert "'./main' is neither a file nor" in refused(execute, "arm.urdf", "--against", "./main")
    (arm / ".git/HEAD").unlink()
    assert "the repository can't be read" in refused(execute, "arm.urdf", "--against", "old.urdf")
    assert said(execute, "arm.urdf", "--against", "./old.urdf")[0] == 0


@NEEDS_GIT
def test_a_mesh_in_large_file_storage(arm: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    from urdfsync.common.files import digest

    content = (arm / "tip.stl").read_bytes()
    pointer = f"version https://git-lfs.github.com/spec/v1\noid sha256:{digest(content)}\nsize {len(content)}\n"
    (arm / "tip.stl").write_text(pointer)
    Repository(arm, monkeypatch).commit()
    (arm / "tip.stl").write_bytes(content)
    assert said(execute, "arm.urdf", "--against", "HEAD") == (0, ["arm.urdf: nothing changed since HEAD"])


OBJECT = """mtllib tip.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
usemtl red
f 1 3 2
f 1 2 4
usemtl blue
f 2 3 4
f 1 4 3
"""


def _write_object(arm: Path, folder: str, text: str) -> None:
    (arm / folder / "tip.obj").write_text(text)
    (arm / folder / "tip.mtl").write_text("newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n")


def _move_the_package(arm: Path) -> None:
    (arm / "parts").rename(arm / "moved")
    _write_object(arm, "moved", OBJECT.replace("1 0 0", "2 0 0"))


def _turn_the_link(arm: Path) -> None:
    (arm / "other").mkdir()
    _write_object(arm, "other", OBJECT.replace("1 0 0", "2 0 0"))
    (arm / "linked").unlink()
    (arm / "linked").symlink_to("other")


@NEEDS_GIT
@pytest.mark.parametrize(
    ("mesh", "change", "told"),
    [
        ("parts/tip.obj", lambda arm: _write_object(arm, "parts", f"# again\n{OBJECT}"), "nothing changed since HEAD"),
        ("package://tool/tip.obj", _move_the_package, "1 parameter change since HEAD"),
        ("linked/tip.obj", _turn_the_link, "1 parameter change since HEAD"),
    ],
    ids=["the colours of an object", "a package of ROS", "a link"],
)
def test_a_revision_has_its_own_files_around_a_mesh(
    arm: Path,
    execute: Execute,
    monkeypatch: pytest.MonkeyPatch,
    mesh: str,
    change: Callable[[Path], object],
    told: str,
) -> None:
    (arm / "parts").mkdir()
    (arm / "parts/package.xml").write_text("<package><name>tool</name></package>")
    (arm / "linked").symlink_to("parts")
    _write_object(arm, "parts", OBJECT)
    (arm / "arm.urdf").write_text(ARM.replace("tip.stl", mesh))
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(arm))
    Repository(arm, monkeypatch).commit()
    change(arm)
    assert said(execute, "arm.urdf", "--against", "HEAD")[1][0] == f"arm.urdf: {told}"


@NEEDS_GIT
def test_mistakes_in_an_older_version_are_those_of_that_version(
    arm: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    (arm / "arm.urdf").write_text(ARM[:300])
    Repository(arm, monkeypatch).commit()
    (arm / "arm.urdf").write_text(ARM)
    assert refused(execute, "arm.urdf", "--against", "HEAD").startswith("HEAD:arm.urdf:")


def test_loads_are_told_if_they_changed(arm: Path, execute: Execute) -> None:
    """Half a metre beside the axis, 2 kg and then 2.5 kg."""
    edit("arm.urdf", "<inertial>", '<inertial><origin xyz="0 0.5 0"/>')
    for mass, code, told in (
        ("2.5", 1, ["  joint elbow gravity torque 9.80665 → 12.2583/54 N·m (+25 %)"]),
        ("2", 0, []),
    ):
        (arm / "new.urdf").write_text(Path("arm.urdf").read_text().replace('mass value="2"', f'mass value="{mass}"'))
        lines = execute("diff", "new.urdf", "--against", "arm.urdf", code=code).lines
        assert [line for line in lines if " gravity " in line] == told


# mistakes


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["arm.urdf"], "there is no last build to compare with; name the version to compare with: --against"),
        (["nothing.urdf", "--against", "arm.urdf"], "there is no file 'nothing.urdf'"),
        (["arm.urdf", "--against=-x"], "'-x' is neither a file nor a git revision"),
        (["arm.urdf", "--against", ""], "'' is neither a file nor a git revision"),
        (["--against", "arm.urdf"], "no urdfsync.toml in"),
        (
            ["arm.urdf", "--config", "no.toml", "--against", "new.urdf"],
            "no.toml: error: the configuration does not exist",
        ),
    ],
)
def test_mistakes_without_a_configuration(arm: Path, execute: Execute, arguments: list[str], complaint: str) -> None:
    assert complaint in refused(execute, *arguments)


def test_no_repository(arm: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(arm.parent))
    assert "there is no file 'HEAD', and no git repository around" in refused(execute, "arm.urdf", "--against", "HEAD")


def test_what_is_in_no_model_is_no_change(arm: Path, execute: Execute) -> None:
    edit("arm.urdf", "</robot>", '<transmission name="t"><joint name="elbow"/></transmission></robot>')
    (arm / "new.urdf").write_text(ARM)
    assert said(execute, "arm.urdf", "--against", "new.urdf")[1] == ["arm.urdf: nothing changed since new.urdf"]


def test_a_removed_element_stands_before_numbers(project: Path, execute: Execute) -> None:
    elements = [{"name": f"R{n}", "between": ["in", "ground"], "ohm": 1.0} for n in range(10, 40)]
    texts = [json.dumps({"name": "many", "elements": elements})]
    texts.append(
        json.dumps({"name": "many", "elements": [{**one, "ohm": n} for n, one in enumerate(elements[:-1], 2)]})
    )
    for text in texts:
        (project / "ladder.json").write_text(text)
        counts, removed = "−1 ~29 (1 structural and 29 parameter changes)", "R39"
        if text == texts[1]:
            found = execute("diff", code=1).lines
            assert (found[0], found[1]) == (f"ladder: {counts} since the last build", f"  {removed}: removed")
            standing = execute("status", code=1).lines
        built = execute("build").lines
    assert built[1:4] == standing[1:4] == [f"  {counts}", f"  {removed}: removed", "  R10: ohm 1 → 2 Ω (+100 %)"]


def test_files_that_are_too_many_are_counted(project: Path, execute: Execute) -> None:
    execute("build")
    for number in range(20):
        add_resistor(f"Shunt{number}")
    assert execute("diff", code=Exit.OUT_OF_STEP).lines[-1].endswith(" more files; --verbose shows them")
