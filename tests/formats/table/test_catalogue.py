"""A robot that takes numbers from a table of motors: what its users do, and what follows."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.networks import edit
from support.remembered import save, saved

from urdfsync.common.dependencies import facts
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Exit
from urdfsync.project import config

EXAMPLE = Path(__file__).parent / "examples/servos"
SERVOS, ELBOW = Path("catalogue/servos.csv"), Path("modelica/Arm/Joints/ElbowParameters.mo")


@pytest.fixture
def project(folder: Path, execute: Execute) -> Path:
    """The example, after a first build."""
    shutil.copytree(EXAMPLE, folder, dirs_exist_ok=True)
    assert "23 files written" in execute("build").out
    return folder


def test_a_changed_row_renews_one_record(project: Path, execute: Execute) -> None:
    edit(SERVOS, "S41,410", "S41,430")
    found = execute("diff", "arm", code=1)
    assert "1 parameter change since the last build" in found.words
    assert "joint elbow: motor S41 / effort 4.1 → 4.3 N·m (+4.88 %)" in found.words
    assert found.out.count("update ") == 1
    assert "servos: 1 file written" in (written := execute("build").words)
    assert "arm: 1 file written" in written
    assert "effort = 4.3)" in ELBOW.read_text()


def test_a_european_catalogue_gives_the_same_numbers(project: Path, execute: Execute) -> None:
    SERVOS.write_text(re.sub(r"(?<=\d)\.(?=\d)", ",", SERVOS.read_text().replace(",", ";")))
    assert "arm: in step" in execute("build").out


@pytest.mark.slow
def test_both_readings_know_the_torque_of_american_data_sheets(
    project: Path, execute: Execute, without_library: None
) -> None:
    edit(SERVOS, "[N.cm]", "[oz-in]")
    execute("build")
    assert "effort = 2.89" in ELBOW.read_text()
    assert "differs" not in execute("check", "arm", code=None).words


def test_a_number_that_no_joint_takes_is_named(project: Path, execute: Execute) -> None:
    edit(SERVOS, "pitch [turn/m],note", "pitch [turn/m],mass [g]")
    for words, mass in (("two stages of spur gears", "60"), ("the same with a longer train", ""), ("a spindle", "")):
        edit(SERVOS, words, mass)
    edit(SERVOS, " of 2 mm a turn", "")
    told = f"{SERVOS}:2: note: no joint takes these columns of the catalogue: `mass`; name a column in `motor_columns`"
    assert told in execute("build", "arm").words


def test_a_row_that_no_joint_has_changes_no_robot(project: Path, execute: Execute) -> None:
    SERVOS.write_text(f"{SERVOS.read_text()}S99,900,20,500,1,5,0.1,,,,\n")
    assert "arm: in step" in execute("build", "arm").out


def test_another_row_is_a_change_of_options(project: Path, execute: Execute) -> None:
    edit(Path("urdfsync.toml"), 'elbow = "S41"', 'elbow = "S60"')
    found = execute("diff", "arm", code=1).words
    assert "the option `motors` changed" in found
    assert "joint elbow: motor S60 / reduction 353.5 → 200" in found


def test_an_edited_number_is_kept(project: Path, execute: Execute) -> None:
    edit(ELBOW, "effort = 4.1)", "effort = 3)")
    edit(SERVOS, "S41,410", "S41,430")
    assert "joint elbow" in execute("build", "arm", code=Exit.CONFLICT).words
    assert "effort = 3)" in ELBOW.read_text()


def test_rows_join_a_urdf_in_utf_16_with_a_comment_behind_the_robot(project: Path, execute: Execute) -> None:
    text = Path("arm.urdf").read_text().replace('encoding="UTF-8"', 'encoding="UTF-16"')
    Path("arm.urdf").write_bytes(f"{text}<!-- the former </robot> -->\n".encode("utf-16"))
    assert "arm: in step" in execute("build", "arm").out
    edit(SERVOS, "S41,410", "S41,four")
    assert "catalogue/servos.csv:3: error: effort of joint `elbow`" in execute("build", "arm", code=Exit.ERROR).words


def test_without_motors_no_catalogue_is_read(project: Path, execute: Execute) -> None:
    Path(TOML).write_text(re.sub("(?m)^motors = .*\n", "", Path(TOML).read_text()))
    SERVOS.unlink()
    assert "the option `motors` changed" in execute("build", "arm").words


def test_the_catalogue_is_a_dependency(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(facts, "YOUNG", 0)
    loaded = config.load(Path("urdfsync.toml"))
    (result,) = build(loaded, loaded.select(["arm"]), BuildOptions())
    assert str(SERVOS.absolute()) in {str(path) for _, path in result.reads}
    save("build", "arm")
    assert saved("build", "arm") is not None
    edit(SERVOS, "S41,410", "S41,430")
    assert saved("build", "arm") is None


@NEEDS_GIT
def test_a_revision_has_the_catalogue_that_it_names(
    project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    repository, text = Repository(project, monkeypatch), Path(TOML).read_text()
    Path(TOML).write_text(re.sub("(?m)^(catalogue|motors) = .*\n", "", text))
    repository.commit()  # HEAD~2 names none
    Path(TOML).write_text(text)
    SERVOS.rename("later.csv")
    repository.commit()  # HEAD~1 lacks its catalogue
    Path("later.csv").rename(SERVOS)
    repository.commit()
    edit(SERVOS, "S41,410", "S41,430")
    SERVOS.rename("later.csv")
    edit(Path(TOML), 'catalogue/servos.csv"\nmotors', 'later.csv"\nmotors')
    Path("arm.urdf").rename("later.urdf")
    edit(Path(TOML), '"arm.urdf"', '"later.urdf"')
    found = execute("diff", "arm", "--against", "HEAD", code=1).words
    assert "1 parameter change since HEAD joint elbow: motor S41 / effort 4.1 → 4.3 N·m" in found
    found = execute("diff", "arm", "--against", "HEAD~1", code=Exit.ERROR).words
    missing = "HEAD~1:catalogue/servos.csv, which can't be read: it does not exist; name a revision that has the file"
    assert f"HEAD~1:urdfsync.toml:10: error: robot `arm`: `catalogue` names {missing}" in found
    found = execute("diff", "arm", "--against", "HEAD~2", code=1).words
    assert "joint elbow: motor S41 / effort 100 → 4.3 N·m" in found
    Path("later.urdf").rename("arm.urdf")
    edit(Path(TOML), '"later.urdf"', '"arm.urdf"')
    shutil.copy("arm.urdf", "other.urdf")
    edit(Path("other.urdf"), '<mass value="4"/>', '<mass value="5"/>')
    found = execute("diff", "arm", "--against", "other.urdf", code=1).words
    assert "link base: inertial / mass 5 → 4 kg" in found
    assert "motor" not in found


def test_a_robot_in_xacro_has_one_too(project: Path, execute: Execute) -> None:
    pytest.importorskip("xacro")
    text = (
        Path("arm.urdf").read_text().replace('<robot name="arm">', '<robot name="arm" xmlns:xacro="http://ros.org/w">')
    )
    Path("arm.urdf.xacro").write_text(text)
    edit(Path("urdfsync.toml"), '"arm.urdf"', '"arm.urdf.xacro"')
    assert "arm: " in execute("build", "arm").out
    assert "effort = 4.1)" in ELBOW.read_text()
    edit(SERVOS, "S41,410", "S41,four")
    assert "catalogue/servos.csv:3: error: effort of joint `elbow`" in execute("build", "arm", code=Exit.ERROR).words


def test_a_workbook_or_data_are_catalogues_too(project: Path, execute: Execute) -> None:
    rows = 'S60 = {"effort [N.m]" = 6}\nS41 = {"effort [N.m]" = 4}\nL200 = {"armature [kg]" = 0.5}\n'
    Path("catalogue/servos.toml").write_text(rows)
    text = Path("urdfsync.toml").read_text().partition("[robots.arm.motor_columns]")[0]
    Path("urdfsync.toml").write_text(
        text.replace('catalogue = "catalogue/servos.csv"', 'catalogue = "catalogue/servos.toml"')
    )
    execute("build", "arm")
    assert "effort = 4)" in ELBOW.read_text()
    assert "armature = 0.5" in ELBOW.with_name("GripParameters.mo").read_text()


TOML, CSV = "urdfsync.toml", str(SERVOS)


@pytest.mark.parametrize(("file", "old", "new", "place"), [
    (TOML, 'elbow = "S41"', 'elbow = "S14"', f"{TOML}:11: error: robot `arm`: the catalogue has no row `S14`"),
    (TOML, 'elbow = "S41"', 'elbo = "S41"', f"{TOML}:11: error: robot `arm`: `motors` names `elbo`"),
    (TOML, 'servos.csv"\nmotors', 'x.csv"\nmotors', f"{TOML}:10: error: robot `arm`: `catalogue` names catalogue/x"),
    (TOML, '"rotor"', '"roter"', f"{CSV}:1: error: there is no column `roter`; did you mean `rotor`?"),
    (TOML, "damping =", "damper =", f"{TOML}:13: error: `motor_columns` must be a table of"),
    (CSV, "[N.cm]", "[kg]", f"{CSV}:2: error: effort of joint `shoulder` in the row `S60`: kg can't"),
])  # fmt: skip
def test_a_fault_has_a_file_and_a_line(
    project: Path, execute: Execute, file: str, old: str, new: str, place: str
) -> None:
    edit(Path(file), old, new)
    found = execute("build", "arm", code=Exit.ERROR)
    assert place in found.words
    assert found.words.count(" error: ") == 1
