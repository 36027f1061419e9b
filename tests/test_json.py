"""`docs/json.md` is true: its examples equal the output of commands, and schemas describe every document."""

from __future__ import annotations

import datetime
import json
import math
import os
import re
import signal
import sys
from pathlib import Path
from typing import Any

import msgspec
import pytest
from support.commands import Execute
from support.documents import is_described

from urdfsync.analysis.checks.results import (
    CheckResult,
    CheckStatus,
    CompiledModel,
    EditEffect,
    JointFit,
    Judgement,
    ToolResult,
)
from urdfsync.analysis.identification.results import Excitation, FittedNumber, Identification, Unexcited
from urdfsync.analysis.simulation import results as simulation
from urdfsync.analysis.simulation.cases import Cases
from urdfsync.analysis.simulation.export import Exported
from urdfsync.analysis.simulation.fmu import FmuTrial
from urdfsync.analysis.simulation.models import Input
from urdfsync.analysis.simulation.outcomes import CaseRange, JointName, JointOutcome, Outcome, Study
from urdfsync.analysis.simulation.results import SimulateResult
from urdfsync.commands import cli
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.domain import ChangeClass, ChangeKind, Role
from urdfsync.domain.experiment import Aspect, Deviation, Mismatch, Numbers, Quantity
from urdfsync.engine.actions import FileStatus, Kind, Reason
from urdfsync.engine.result import Checked, Result
from urdfsync.output.documents import JSON_VERSION
from urdfsync.project import config
from urdfsync.watch import events
from urdfsync.watch.report import event_values, show_json

PAGE = (Path(__file__).parents[1] / "docs" / "json.md").read_text(encoding="utf-8")
CONFLICTS = (Path(__file__).parents[1] / "docs" / "conflicts.md").read_text(encoding="utf-8")
(BUILD,) = [json.loads(text) for text in re.findall(r"```json\n(.*?)```", PAGE, re.DOTALL)]
(SESSION,) = (
    [json.loads(line) for line in text.splitlines()] for text in re.findall(r"```jsonl\n(.*?)```", PAGE, re.DOTALL)
)

URDF = """<robot name="arm">
  <link name="base"/>
  <link name="tip">
    <visual><geometry><mesh filename="package://arm/tip.stl"/></geometry></visual>
  </link>
  <joint name="hold" type="fixed"><parent link="base"/><child link="tip"/></joint>
</robot>
"""

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the examples have paths of POSIX")


@pytest.fixture
def folder(folder: Path) -> Path:
    (folder / "arm.urdf").write_text(URDF)
    return folder


def printed(execute: Execute, folder: Path, *arguments: str) -> Any:
    """The output of a command, with the folder of the examples."""
    streams = execute(*arguments, "--format=json", code=None)
    assert streams.err == ""
    assert streams.out.isascii()
    text = streams.out.replace(str(folder), "/home/me/project")
    if arguments and arguments[0] in cli._COMMANDS:
        assert is_described(json.loads(text), arguments[0])
    return json.loads(text.replace(str(config.library_folder()), "/opt/urdfsync/modelica"))


def matches(example: Any, real: Any) -> bool:
    """Whether two documents are equal, except items of lists that an example leaves out."""
    if isinstance(example, dict):
        return example.keys() == real.keys() and all(matches(example[key], real[key]) for key in example)
    if isinstance(example, list):
        return bool(example) == bool(real) and all(any(matches(item, other) for other in real) for item in example)
    return bool(example == real)


DOCUMENT = {"version", "command", "exit", "results", "diagnostics"}
FINDING = {"severity", "code", "message", "file", "line", "column", "hint", "details", "element", "is_new"}


def test_init(folder: Path, execute: Execute) -> None:
    (robot,) = printed(execute, folder, "init", "arm.urdf")["results"]
    (folder / "other.urdf").write_text(URDF)
    (other,) = printed(execute, folder, "add", "other.urdf")["results"]
    assert (robot["package"], other["package"]) == ("Arm", "Other")


def test_record(folder: Path, execute: Execute) -> None:
    assert printed(execute, folder, "record", "arm.urdf", "-o", "Arm.mo")["results"][0]["is_written"]
    assert printed(execute, folder, "record", "arm.urdf")["results"][0]["text"].startswith("within")


MOVED = URDF.replace('<child link="tip"/>', '<child link="tip"/><origin xyz="0 0 0.1"/>')


def test_build(folder: Path, execute: Execute) -> None:
    cli.main(["init", "arm.urdf"])
    cli.main(["build"])
    (folder / "arm.urdf").write_text(MOVED)
    assert matches(BUILD, printed(execute, folder, "build"))
    (folder / "urdfsync.toml").write_text("\n[robots.arm]\nsource = 'arm.urdf'\nsorce = 'x'\npackage = 'Arm'\n")
    mistake = printed(execute, folder, "build")
    assert mistake.keys() == DOCUMENT
    assert mistake["diagnostics"][0].keys() == FINDING


def edited(folder: Path) -> None:
    """A project in which source and user gave a link different masses."""
    inertia = '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
    (folder / "arm.urdf").write_text(URDF.replace('"tip">', f'"tip"><inertial><mass value="2"/>{inertia}</inertial>'))
    cli.main(["init", "arm.urdf"])
    cli.main(["build"])
    record = folder / "modelica/Arm/Links/TipParameters.mo"
    record.write_text(record.read_text().replace("mass = 2,", "mass = 2.5,"))
    (folder / "arm.urdf").write_text((folder / "arm.urdf").read_text().replace('mass value="2"', 'mass value="3"'))


def test_commands_that_plan_have_the_document_of_a_build(folder: Path, execute: Execute) -> None:
    edited(folder)
    commands = "status", "build", "resolve --all --merge", "remove arm --dry-run", "adopt arm"
    for command in commands:
        assert [robot["robot"] for robot in printed(execute, folder, *command.split())["results"]] == ["arm"]
    (compared,) = printed(execute, folder, "diff", "arm.urdf")["results"]
    assert compared["result"]["robot"] == "arm"
    (robot,) = printed(execute, folder, "diff", "--edits")["results"]
    assert [edit["mine"] for file in robot["files"] for edit in file["edits"]] == ["2.5"]


def test_saved_texts_are_where_a_conflict_says(folder: Path, execute: Execute) -> None:
    edited(folder)
    ((conflict,),) = (robot["conflicts"] for robot in printed(execute, folder, "build")["results"])
    assert all((folder / conflict["saved"][name]).is_file() for name in ("base", "generated", "merge"))


def watched(folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> list[Any]:
    """The output of `watch` while a source is saved without a link, then complete with the joint moved."""
    moved = '<child link="tip"/><origin xyz="0 0 0.1"/>'
    part = URDF.replace('"tip">', '"top">')
    saves = {"Built": part, "Waiting": URDF.replace('<child link="tip"/>', moved)}

    def listen(event: events.Event) -> None:
        show_json(event)
        if text := saves.pop(type(event).__name__, ""):
            (folder / "new").write_text(text)
            (folder / "new").replace(folder / "arm.urdf")
        elif isinstance(event, events.Built) and not saves:
            os.kill(os.getpid(), signal.SIGTERM)

    monkeypatch.setattr("urdfsync.watch.report.show_json", listen)
    streams = execute("watch", "--settle", "0", "--format=json")
    assert streams.err == ""
    assert streams.out.isascii()
    lines = [json.loads(line) for line in streams.out.replace(str(folder), "/home/me/project").splitlines()]
    assert all(is_described(line, "watch") for line in lines)
    return lines


def test_watch(folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    cli.main(["init", "arm.urdf"])
    cli.main(["build"])
    found = watched(folder, execute, monkeypatch)
    times = [datetime.datetime.fromisoformat(event["time"]) for event in found]
    assert times == sorted(times)
    assert all(time.tzinfo for time in times)
    events_of_session = [{**event, "time": ""} for event in found]
    assert all({**event, "time": ""} in events_of_session for event in SESSION)
    (built,) = (event for event in found if event["event"] == "built" and event["files"])
    assert [action["reason"] for action in built["result"]["actions"]] == ["update"]


def test_a_daemon_that_can_not_start_says_so_in_one_line(folder: Path, execute: Execute) -> None:
    (folder / "urdfsync.toml").write_text("[robots.arm]\nsorce = 'x'\n")
    (line,) = execute("watch", "--format=json", code=2).lines
    document = json.loads(line)
    assert is_described(document, "watch")
    assert (document["command"], document["exit"]) == ("watch", 2)
    assert {"command", "exit", "diagnostics"} <= document.keys()


def test_the_other_events_look_as_shown() -> None:
    warning = Diagnostic(
        Severity.WARNING,
        "exec",
        "robot `arm`: the command of --exec ended with exit code 2",
        hint="correct the command: it runs again after the next build that changes a file",
    )
    failure = Diagnostic(Severity.ERROR, "system", "Permission denied", "arm.urdf")
    place, words = ("modelica/Arm/Arm.mo", 12, 3), "there is no class `Sensor`"
    mistake = Diagnostic(Severity.ERROR, "compile", words, *place, hint="correct it")
    folder = Path("/home/me/project/modelica/Arm")
    failed = Result(
        robot="arm", package="Arm", folder=folder, root=Path("/home/me/project"), diagnostics=(failure,), failed=True
    )
    others: tuple[events.Event, ...] = (
        events.Unchanged("arm"),
        events.Failed(failed),
        events.Checking("arm"),
        events.CheckDone("arm", Checked.WRONG, 2.464, (mistake,)),
        events.Running("arm"),
        events.Ran("arm", 2),
        events.Noted((warning,)),
    )
    time = datetime.datetime(2026, 3, 4, tzinfo=datetime.UTC)
    shown = [json.loads(json.dumps(event_values(event, time))) for event in others]
    assert all(is_described(event, "watch") for event in shown)


def checked() -> CheckResult:
    """An arm with an edited joint; the simulation has no series for one link."""
    hand = Deviation(Quantity.POSITION, "link tip", math.inf, 0.5, 0.5, "m")
    swing = Deviation(Quantity.EFFORT, "joint hold", 0.025, 1.25, 1.25, "N·m")
    exact = msgspec.structs.replace(swing, difference=2.5e-16)
    differing = Mismatch("joint hold", "limits.effort", "130", "150", "Joints/HoldParameters.mo", 12, "arm.urdf", 34)
    first = ToolResult(tool="rumoca 0.10.2", deviations=(hand, exact), effects=(), seconds=12.5)
    second = ToolResult(tool="OpenModelica 1.27.0", compiled=(CompiledModel("Arm", 410),), seconds=31.5)
    return CheckResult(
        "arm",
        "Arm",
        freedoms=1,
        tools=(first, second),
        between=(exact,),
        tool="rumoca 0.10.2 and OpenModelica 1.27.0",
        compiled=(CompiledModel("Arm", 0), CompiledModel("ArmRun", 412)),
        failing=("Cell",),
        deviations=(hand, exact),
        effects=(EditEffect(("Joints/Hold_joint.mo",), (swing,), ("joint hold",)),),
        notes=('link "tip" has made-up inertias, because it moves without any mass',),
        unchecked=("limits (they change no motion) are not compared",),
        gaps=("`Spring` was not compiled by itself, because its file does not parse",),
        diagnostics=(Diagnostic(Severity.WARNING, "mesh-not-found", "mesh not found; left out", "arm.urdf", 4),),
        seconds=4.25,
        reference="Pinocchio 4.1.0",
        numbers=Numbers(411, 412, (differing,), (differing,), ("reach of records (1 number)",)),
        edited=("Joints/Hold_joint.mo",),
        log=Judgement("log.csv", 20.0, (JointFit("joint hold", "N·m", 5.0, 2.0, 2.0, 0.0, 200),)),
    )


def test_check(folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    cli.main(["init", "arm.urdf"])
    monkeypatch.setattr("urdfsync.commands.check.check_robots", lambda *_: iter([checked()]))
    document = printed(execute, folder, "check", "--physics")
    assert json.loads(json.dumps(document, allow_nan=False)) == document


def simulated() -> SimulateResult:
    """An arm whose joint passes a limit."""
    place = "robot.hold"
    position = simulation.Range(f"{place}.revolute.phi", "rad", 0.0, 1.25, -1.0, 1.0)
    speed = simulation.Range(f"{place}.revolute.w", "rad/s", 0.0, 2.5, None, None)
    passed = simulation.PassedLimit("position", 1.0, 0.75, 0.25, 0.5)
    warning = Diagnostic(Severity.WARNING, "limit-passed", "joint hold: position passes its limit, 1 rad")
    joint = simulation.JointResult("joint hold", "robot", position, speed, passed=(passed,))
    series = {"time": (0.0, 0.5, 1.0)}
    loop = simulation.LoopResult("loop pin", "robot", 1e-9, 12.0, 0.0)
    difference = simulation.QuantityDifference("position", "rad", 0.25, 0.5, 0.0, 1.0)
    differing = simulation.JointDifference("joint hold", "robot", "joint grip", (difference,))
    against = simulation.Against("HEAD~1", (differing,), ("joint lift",))
    numbers = "arm", "Arm.ArmTest", 1.0, 0.5, 1e-6
    return SimulateResult(*numbers, (joint,), series, (warning,), 8.25, is_known=False, loops=(loop,), against=against)


def test_simulate(folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    cli.main(["init", "arm.urdf"])
    monkeypatch.setattr("urdfsync.analysis.simulation.run.simulate", lambda *_: simulated())
    monkeypatch.setattr("urdfsync.analysis.simulation.files.write_outputs", lambda *_: None)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: name)
    files = ("--csv", "arm.csv", "--plot", "arm.png")
    document = printed(execute, folder, "simulate", *files)
    monkeypatch.setattr("urdfsync.analysis.simulation.vary.vary", lambda *_: varied())
    (study,) = printed(execute, folder, "simulate", "--vary", "mass=1..2")["results"]
    assert [case["status"] for case in study["cases"]] == ["within", "failed"]
    assert document["results"][0]["files"] == {"csv": "arm.csv", "plot": "arm.png"}


def identified() -> Identification:
    """An arm with one fitted number."""
    joint = JointFit("joint hold", "N·m", 5.0, 2.0, 0.1, 0.01, 200)
    number = FittedNumber("joint hold", "dynamics.damping", 1.0, 1.25, 0.02, is_written=True)
    about = "arm", "log.csv", 20.0, 500.0, 5.5, 0.004
    stays = (Unexcited("link tip", ("inertial.mass",)),)
    return Identification(*about, (joint,), (number,), stays, dropped=("1 gap",), held_out=(joint,))


def test_identify(folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    cli.main(["init", "arm.urdf"])
    motion = "time\n", Excitation("arm", 20.0, 90.0, 12.0, 30, ("hold",), {})
    monkeypatch.setattr("urdfsync.analysis.identification.run.identify", lambda *_, **__: identified())
    monkeypatch.setattr("urdfsync.analysis.identification.run.find_motion", lambda *_: motion)
    monkeypatch.setattr("urdfsync.analysis.identification.plot.draw", lambda *_: b"")
    monkeypatch.setattr("importlib.util.find_spec", lambda name: name)
    (fitted,) = printed(execute, folder, "identify", "arm", "log.csv", "--plot", "arm.png")["results"]
    (excited,) = printed(execute, folder, "identify", "arm", "--excite", "motion.csv")["results"]
    assert (fitted["numbers"][0]["after"], excited["numbers"]) == (1.25, 30)


def varied() -> Study:
    """A model in two cases, of which one failed."""
    joint = JointOutcome((None, None, CaseRange(0.0, 8.0, -20.0, 20.0), None), None, None, ())
    outcome = Outcome((JointName("joint hold", "robot", ("", "", "N·m", "")),), (joint,))
    cases, failed = Cases(("mass",), [(1.0,), (2.0,)]), Outcome(problem="the simulation stops at 1 s")
    return Study("arm", "Arm.ArmTest", 10.0, 0.02, 1e-6, cases, [outcome, failed], 12.5, 0, "urdfsync simulate arm")


def test_fmu(folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    cli.main(["init", "arm.urdf"])
    inputs, tool = (Input("hold_phi", "rad"),), "OpenModelica 1.27.0"
    exported = Exported(b"1234", "Arm.ArmRun", "Arm_ArmRun", inputs, 1.0, 0.002, 1e-10, tool, (), 12.5)
    trial = FmuTrial((), {"me": 2.5e-9, "cs": 4e-8}, {"me": "hold_tau", "cs": "hold_tau"}, 3)
    monkeypatch.setattr("urdfsync.commands.fmu.export", lambda *_, **__: exported)
    monkeypatch.setattr("urdfsync.commands.fmu.try_out", lambda *_: trial)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: name)
    (written,) = printed(execute, folder, "fmu", "--check")["results"]
    assert written["trial"]["compared"] == 3


def test_library(folder: Path, execute: Execute) -> None:
    assert printed(execute, folder, "library")["results"][0]["folder"] == "/opt/urdfsync/modelica"


def test_values_that_are_one_of_a_few_are_all_named(execute: Execute) -> None:
    few = (*Kind, *Role, *FileStatus, *ChangeKind, *ChangeClass, *CheckStatus, *Quantity, *Aspect)
    schemas = execute("schema", "build").out + execute("schema", "check").out
    assert all(f'"{word}"' in schemas for word in (*few, *Checked))
    reasons = re.findall(r"^\|.*\|([^|]*)\|$", CONFLICTS.partition("| `reason` |")[2], re.MULTILINE)
    assert {f"`{reason}`" for reason in Reason} == set(re.findall(r"`[\w-]+`", "".join(reasons)))
    assert f"`version` is {JSON_VERSION}" in PAGE


@pytest.mark.parametrize("arguments", [[], ["biuld"], ["build", "--svg", "--check"], ["check", "--jobs", "0"]])
def test_bad_usage_is_a_document_as_well(folder: Path, execute: Execute, arguments: list[str]) -> None:
    document = printed(execute, folder, *arguments)
    assert (document["exit"], document["diagnostics"][0]["code"]) == (2, "usage")
    assert document.keys() == DOCUMENT
