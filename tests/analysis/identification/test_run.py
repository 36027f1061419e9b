"""`urdfsync identify`: what it shows, what it writes, and what it refuses."""

from __future__ import annotations

import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from support import measured
from support.commands import Execute
from support.files import unchanged
from support.git import NEEDS_GIT, Repository
from support.patches import patch_and_told

import urdfsync
from urdfsync.analysis.checks.results import JointFit, Judgement
from urdfsync.analysis.identification.results import IdentifyOptions
from urdfsync.analysis.identification.run import _doubts, judge
from urdfsync.engine.options import no_progress

DRIVE = Path("modelica/Gripper/Joints/DriveParameters.mo")


@pytest.mark.slow
def test_a_fit_is_shown_and_nothing_is_written(gripper: Path, execute: Execute) -> None:
    with unchanged(gripper):
        printed = execute("identify", "gripper", "log.csv")
    assert printed.lines[0].startswith("gripper: log.csv, 8 s at 500 Hz, filtered at ")
    row = next(line.split() for line in printed.lines if line.startswith("  drive "))
    assert float(row[2]) > 20 * float(row[3]), "the error falls"
    assert "  joint drive  friction" in printed.out
    assert "    link right: all" in printed.lines
    assert printed.lines[-1] == "  nothing written: `--write` writes the numbers into the records"


@pytest.mark.slow
def test_a_document_has_what_is_shown(gripper: Path, execute: Execute) -> None:
    (result,) = execute("identify", "gripper", "log.csv", "--until", "6", "--format=json").json["results"]
    friction = next(each for each in result["numbers"] if each["path"] == "dynamics.friction")
    # MuJoCo's gripper: both joints rub, and the follower's friction is not told from the leader's
    assert friction["after"] == pytest.approx(0.0273, rel=0.05)
    assert [joint["element"] for joint in result["held_out"]] == ["joint drive"]
    assert result["held_out"][0]["after"] < 0.05 * result["held_out"][0]["before"]
    assert {"element": "joint other", "paths": ["dynamics.damping", "dynamics.friction"]} in result["unexcited"]


@pytest.mark.slow
def test_a_chosen_joint_alone_is_fitted(gripper: Path, execute: Execute) -> None:
    (result,) = execute("identify", "gripper", "log.csv", "--joint", "drive", "--format=json").json["results"]
    assert {number["element"] for number in result["numbers"]} == {"joint drive"}
    assert result["unexcited"] == []


@NEEDS_GIT
def test_measure_identify_merge_patch_build(gripper: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    """Fitted numbers meet an export that changes two masses, go into the source as a patch, and all is in step."""
    repository = Repository(gripper, monkeypatch)
    execute("identify", "gripper", "log.csv", "--write")
    assert "dynamics.friction 0.03 → " in execute("diff", "--edits").out
    source = Path("gripper.urdf").read_text()
    Path("gripper.urdf").write_text(source.replace('"0.21"', '"0.22"').replace('"0.19"', '"0.2"'))
    execute("build", "--merge", "--quiet")
    assert "mass = 0.22," in Path("modelica/Gripper/Links/LeftParameters.mo").read_text()
    patch, told = patch_and_told()
    assert told == []
    subprocess.run(["git", "apply"], input=patch, check=True, cwd=repository.folder)
    execute("build", "--quiet")
    execute("build", "--check", "--quiet")
    assert execute("diff", "--edits").lines == ["gripper: nothing is edited"]
    assert '<mass value="0.22"/>' in Path("gripper.urdf").read_text()
    (result,) = execute("identify", "gripper", "log.csv", "--format=json").json["results"]
    assert result["joints"][0]["before"] < 0.1 * result["joints"][0]["measured"]


@pytest.mark.slow
def test_the_users_layout_stays(gripper: Path, execute: Execute) -> None:
    """Only literals change: comments, blanks and line ends are the user's."""
    text = DRIVE.read_text().replace("friction = 0.03", "friction  =  0.03 /* greased */").replace("\n", "\r\n")
    DRIVE.write_bytes(text.encode())
    execute("identify", "gripper", "log.csv", "--joint", "drive", "--write")
    written = DRIVE.read_bytes().decode()
    assert "/* greased */" in written
    assert written.count("\r\n") == text.count("\r\n")
    assert [a.partition("=")[0] for a in written.split("\n")] == [a.partition("=")[0] for a in text.split("\n")]


@pytest.mark.slow
def test_a_fit_begins_with_the_users_numbers(gripper: Path, execute: Execute) -> None:
    DRIVE.write_text(DRIVE.read_text().replace("friction = 0.03", "friction = 0.0271"))
    (result,) = execute("identify", "gripper", "log.csv", "--joint", "drive", "--format=json").json["results"]
    assert next(each["before"] for each in result["numbers"] if each["path"] == "dynamics.friction") == 0.0271


@pytest.mark.slow
def test_a_plot_is_written(gripper: Path, execute: Execute) -> None:
    execute("identify", "gripper", "log.csv", "--plot", "efforts.svg")
    text = Path("efforts.svg").read_text()
    assert "measured" in text
    assert "drive [N·m]" in text


@pytest.mark.slow
def test_a_model_is_judged_by_one_number(gripper: Path, execute: Execute) -> None:
    """The number falls when the fit is written."""
    before = judged()
    execute("identify", "gripper", "log.csv", "--write")
    assert before.misfit == pytest.approx(before.joints[0].before / before.joints[0].measured)
    assert judged().misfit < 0.1 * before.misfit


@pytest.mark.slow
def test_explained_is_one_number(gripper: Path, execute: Execute) -> None:
    """The share after a fit is that of the written records in `check --log`; sure numbers alone explain it."""
    (result,) = execute("identify", "gripper", "log.csv", "--write", "--format=json").json["results"]
    before, after = result["joints"][0], judged().joints[0]
    assert before["explained"] == pytest.approx(1 - before["after"] / before["measured"])
    assert after.explained == pytest.approx(before["explained"], abs=1e-4)
    assert all(number["is_sure"] for number in result["numbers"] if number["before"] == 0)


@pytest.mark.slow
def test_only_sure_numbers_are_written(gripper: Path, execute: Execute) -> None:
    """With too few numbers to explain the log no change is sure; `--all` writes it all the same."""
    arguments = ["identify", "gripper", "log.csv", "--joint", "drive", "--write"]
    with unchanged(gripper):
        printed = execute(*arguments)
    assert "(not sure)" in printed.out
    assert printed.lines[-1] == "  nothing written: no change is sure, so each number stays"
    assert execute(*arguments, "--all").lines[-1].startswith("  1 record written")
    assert "`--all` needs `--write`" in execute(*arguments[:-1], "--all", code=2).words


@pytest.mark.slow
def test_errors_contain_those_of_the_numbers_that_stay(gripper: Path, execute: Execute) -> None:
    """Masses of the source are wrong, and stay: the real numbers are within three errors, but no conditional ones."""
    (result,) = execute("identify", "gripper", "log.csv", "--format=json").json["results"]
    truth = {"origin.xyz[2]": 1, "origin.xyz[3]": 2}
    root = ET.fromstring(measured.changed(measured.GRIPPER, 1))
    centre = root.find("link[@name='left']/inertial/origin")
    assert centre is not None
    apart = []
    for number in result["numbers"]:
        place = truth.get(number["path"].removeprefix("inertial."))
        if number["element"] == "link left" and place:
            error = number["after"] - float(centre.get("xyz", "").split()[place])
            assert abs(error) < 3 * number["error"]
            apart.append(abs(error) / number["conditional"])
    assert max(apart) > 6


def judged() -> Judgement:
    loaded = urdfsync.load()
    return judge(loaded, loaded.robots[0], Path("log.csv"), IdentifyOptions(), no_progress)


@pytest.mark.slow
def test_a_log_judges_a_model(gripper: Path, execute: Execute) -> None:
    (result,) = execute("check", "gripper", "--log", "log.csv", "--format=json").json["results"]
    words, log = execute("check", "gripper", "--log", "log.csv").words, result["log"]
    assert f"log.csv: {100 * log['misfit']:.1f} % of the measured efforts unexplained ({log['seconds']:.3g} s)" in words
    assert 5 < log["seconds"] < 10
    assert "joint drive: " in words


def test_a_build_loads_nothing_of_it(gripper: Path) -> None:
    code = "import sys; from urdfsync.commands import cli; cli.main(['build', '--full', '-q']); print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout.split()
    assert not {"pinocchio", "scipy", "pyarrow", "matplotlib"} & {*loaded}
    assert [
        name for name in loaded if name.startswith("urdfsync.analysis.identification") or name.endswith("regressor")
    ] == []


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ("conflict", "robot `gripper` is in conflict; resolve the conflicts: `urdfsync resolve`"),
        ("export", "robot `gripper` is out of step with its source; run `urdfsync build`"),
        ("formula", "joint drive: dynamics.friction is edited to `2*0.01`, which is no number"),
        ("model", "DriveParameters.mo: error: the edited file is no single record"),
    ],
)
def test_a_robot_that_is_not_ready(gripper: Path, execute: Execute, change: str, words: str) -> None:
    edits = {"conflict": "0.04", "formula": "2*0.01"}
    text = DRIVE.read_text()
    DRIVE.write_text(text.replace("friction = 0.03", f"friction = {edits.get(change, '0.03')}"))
    if change == "model":
        DRIVE.write_text(text.replace("record Drive", "model Drive").replace("end Drive", "end Drive"))
    if change in ("conflict", "export"):
        source = Path("gripper.urdf").read_text().replace('friction="0.03"', 'friction="0.05"')
        Path("gripper.urdf").write_text(source)
    with unchanged(gripper):
        printed = execute("identify", "gripper", "log.csv", "--write", code=2)
    assert words in printed.words
    assert len(printed.errors) == 1


@pytest.mark.slow
def test_a_source_that_a_command_makes(gripper: Path, execute: Execute) -> None:
    """Its records are written all the same; a patch then says that its source can't take them."""
    Path("urdfsync.toml").write_text(
        '[robots.gripper]\nsource = "gripper.urdf"\npackage = "Gripper"\n'
        'command = ["cp", "made.urdf", "gripper.urdf"]\nignore = ["not-mirrored"]\n'
    )
    Path("made.urdf").write_text(measured.GRIPPER)
    execute("build", "--trust", "--quiet")
    execute("identify", "gripper", "log.csv", "--joint", "drive", "--write", "--all")
    _, (line,) = patch_and_told(code=2)
    assert "its source is made by a command" in line


@pytest.mark.slow
def test_what_can_not_be_chosen(gripper: Path, execute: Execute) -> None:
    for arguments, words in (
        (["--joint", "drivee"], "`drivee` is no joint that moves and has numbers; did you mean `drive`?"),
        (["--link", "palm"], "`palm` is no link that moves and has numbers; choose from left, right"),
        (["--plot", "log.csv"], "a plot is one of .png, .svg"),
    ):
        assert words in execute("identify", "gripper", "log.csv", *arguments, code=2).words
    assert "name a log, or a file for a motion with `--excite`" in execute("identify", "gripper", code=2).words


def test_a_joint_that_never_moves(gripper: Path, execute: Execute, recording: measured.Recording) -> None:
    still = recording._replace(positions=np.full_like(recording.positions, 0.3))
    still.write(Path("still.csv"))
    printed = execute("identify", "gripper", "still.csv", code=2)
    assert "still.csv has no sample that can be fitted" in printed.words
    assert len(printed.errors) == 1


@pytest.mark.slow
def test_efforts_of_another_sign_are_told(gripper: Path, execute: Execute, recording: measured.Recording) -> None:
    recording._replace(efforts=-recording.efforts).write(Path("other.csv"))
    with unchanged(gripper):
        printed = execute("identify", "gripper", "other.csv", "--write", code=5)
    assert "error: joint drive: no numbers explain its effort" in printed.words
    assert printed.lines[-1] == "  nothing written: the log is hardly that of the robot"


def test_efforts_that_are_always_0(gripper: Path, execute: Execute, recording: measured.Recording) -> None:
    recording._replace(efforts=np.zeros_like(recording.efforts)).write(Path("zero.csv"))
    printed = execute("identify", "gripper", "zero.csv", code=2)
    assert "zero.csv has no sample that can be fitted" in printed.words
    assert "whose effort is constant" in printed.words
    words = execute("identify", "gripper", "log.csv", "--cutoff", "400", code=2).words
    assert "a cut-off frequency of 400 Hz is too high for 500 rows per second" in words


def test_a_wrong_sign_that_other_numbers_hide_is_told() -> None:
    """What is left after the fit looks good; the source's own numbers explain less than none would."""
    shoulder = JointFit("joint shoulder", "N·m", measured=20.0, before=40.0, after=0.5, offset=0.0, samples=9)
    light = JointFit("joint light", "N·m", measured=0.1, before=0.2, after=0.01, offset=0.0, samples=9)
    (told,) = _doubts([shoulder, light])
    assert "joint shoulder: the source's numbers are worse than none, 200 % of its effort is left" in told.message


@pytest.mark.slow
def test_a_time_that_holds_nothing_out_or_leaves_nothing(gripper: Path, execute: Execute) -> None:
    printed = execute("identify", "gripper", "log.csv", "--until", "60")
    assert "`--until 60` holds nothing out: the log has no sample after that time" in printed.words
    printed = execute("identify", "gripper", "log.csv", "--until", "0.1", code=2)
    assert "`--until 0.1` leaves too little of log.csv to fit" in printed.words


@pytest.mark.slow
def test_a_joint_that_stands_still_is_named(leg: Path, execute: Execute) -> None:
    times = np.arange(0, 8, 0.01)
    moving, still = np.sin(3 * times), np.full_like(times, -1.5)
    rows = np.column_stack([times, 0.5 * moving, moving, still, 5 * moving, 6 * moving, 1 + 0.1 * moving])
    header = "time," + ",".join(f"{joint}.{what}" for what in ("q", "tau") for joint in ("hip", "thigh", "calf"))
    np.savetxt("still.csv", rows, "%.9g", ",", header=header, comments="")
    printed = execute("identify", "leg", "still.csv", "--joint", "hip", code=5)  # its efforts are no robot's
    assert "whose effort is constant or at its limit: all of calf" in printed.words
    assert "joint calf: it stands still, or its effort is constant, so it can't be fitted" in printed.words


def test_a_robot_without_joints_to_fit(folder: Path, execute: Execute) -> None:
    joint = '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
    Path("box.urdf").write_text(f'<robot name="box"><link name="a"/><link name="b"/>{joint}</robot>')
    Path("urdfsync.toml").write_text('[robots.box]\nsource = "box.urdf"\npackage = "Box"\n')
    execute("build", "--quiet")
    Path("log.csv").write_text("time,j.position,j.effort\n0,0,0\n")
    for arguments in (["log.csv"], ["--excite", "motion.csv"]):
        printed = execute("identify", "box", *arguments, code=2)
        assert "the robot has no joint that can be fitted" in printed.words
        assert len(printed.errors) == 1
