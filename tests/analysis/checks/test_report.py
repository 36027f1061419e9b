"""What people see of a check: a line for each robot, what belongs to it below, and what holds for all at the end."""

from __future__ import annotations

import math
from pathlib import Path

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.analysis.checks.report import closing_lines
from urdfsync.analysis.checks.results import CheckResult, CompiledModel, EditEffect
from urdfsync.commands.check import show_result
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.domain.experiment import Aspect, Deviation, Mismatch, Numbers, Quantity
from urdfsync.output.console import Console

Capture = pytest.CaptureFixture[str]

COMPILED = (CompiledModel("Arm", 1000), CompiledModel("ArmRun", 1204), CompiledModel("ArmTest", 1100))


def load(element: str, difference: float, value: float, unit: str = "N·m") -> Deviation:
    return Deviation(Quantity.EFFORT, element, difference, value, 60.0, unit, Aspect.LOSSES)


AGREEING = (
    Deviation(Quantity.POSITION, "link hand", 2.4e-16, 0.9, 1.2, "m"),
    Deviation(Quantity.ORIENTATION, "link hand", 1.1e-16, 1.0, 1.0, ""),
    load("joint elbow", 8.4e-14, 21.0),
    load("joint wrist", 4.2e-14, 2.0),
    Deviation(Quantity.MASS, "robot", 0.0, 25.0, 25.0, "kg"),
    Deviation(Quantity.CENTRE, "robot", 1.1e-16, 0.3, 0.3, "m"),
)
LIMIT = Mismatch("joint elbow", "limits.effort", "130", "150", "Joints/ElbowParameters.mo", 12, "arm.urdf", 34)
BROKEN = Diagnostic(
    Severity.ERROR, "syntax", "the file does not end with `end Wheel;`", "modelica/Cart/Joints/Wheel.mo", 14
)
RIGHT = CheckResult(
    "arm",
    "Arm",
    numbers=Numbers(412, 412),
    freedoms=6,
    tool="rumoca 0.10.2",
    compiled=COMPILED,
    deviations=AGREEING,
    notes=("inertias were made up for 3 links",),
    unchecked=("shapes",),
    seconds=12.41,
    reference="Pinocchio 4.1.0",
)
EDITED = msgspec.structs.replace(
    RIGHT,
    robot="loader",
    notes=(),
    numbers=Numbers(411, 412, edits=(LIMIT,)),
    edited=(LIMIT.file, "Joints/Elbow.mo", "Links/Hand.mo"),
    effects=(
        EditEffect(("Joints/Elbow.mo",), (load("joint elbow", 0.672, 21.0),), ("joint elbow",)),
        EditEffect(("Links/Hand.mo",), (), ("link hand",)),
    ),
)
INCOMPLETE = msgspec.structs.replace(
    RIGHT,
    robot="welder",
    notes=(),
    gaps=("the effect of your edits was not measured: `robot.hand.body.m` is not declared",),
)
WRONG = msgspec.structs.replace(RIGHT, robot="picker", notes=(), deviations=(*AGREEING, load("joint mimic", 0.4, 12.5)))
FAILED = CheckResult(
    "cart", "Cart", gaps=("nothing was compiled, since files have errors",), diagnostics=(BROKEN,), seconds=0.9
)
ABSENT = msgspec.structs.replace(RIGHT, robot="new", notes=(), built=False, in_step=False)
STALE = msgspec.structs.replace(ABSENT, robot="hoist", built=True)
TORN = msgspec.structs.replace(STALE, robot="lift", conflicting=True)
ALL = (RIGHT, EDITED, INCOMPLETE, WRONG, FAILED, ABSENT, STALE, TORN)


def shown(capsys: Capture, *results: CheckResult, strict: bool = False, **options: bool) -> list[str]:
    """The lines on the output stream."""
    capsys.readouterr()
    console = Console(**options)  # type: ignore[arg-type]
    for result in results:
        show_result(console, msgspec.structs.replace(result, strict=strict))
    console.tell(closing_lines(results))
    return capsys.readouterr().out.splitlines()


def test_lines_are_as_on_the_page(capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    """On a terminal with signs, in a pipe without."""
    page = (Path(__file__).parents[3] / "docs/checking.md").read_text(encoding="utf-8")
    *example, finding = page.partition("```text\n")[2].partition("```")[0].splitlines()
    assert finding == f"{BROKEN}"
    lines = shown(capsys, *ALL)
    signs = {
        "arm": "✓",
        "loader": "✓",
        "welder": "!",
        "picker": "✗",
        "cart": "✗",
        "new": "!",
        "hoist": "!",
        "lift": "!",
    }
    signed = [line if line.startswith(" ") else f"{signs.get(line.partition(':')[0], '')} {line}" for line in lines]
    assert signed[: len(example)] == example
    rest = example[0].partition("right")[2]
    assert lines[len(example) :] == [
        f"new: not built{rest}",
        "  there is no package yet; the files that `urdfsync build` would write were checked",
        f"hoist: out of step{rest}",
        "  the package is out of step; run `urdfsync build`",
        f"lift: out of step{rest}",
        "  files are in conflict; settle them with `urdfsync resolve`",
        "not compared: shapes (arm, loader and 5 more)",
        "for the comparison: inertias were made up for 3 links (arm)",
        "8 robots: 2 right, 1 incomplete, 2 out of step, 1 not built, 1 differs, 1 failed",
    ]
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm")
    assert "\x1b[32m✓" in shown(capsys, RIGHT)[0]
    monkeypatch.setenv("NO_COLOR", "1")
    assert [line.rstrip() for line in shown(capsys, *ALL)][: len(example)] == example


def test_differing_numbers_come_first_and_those_of_one_file_are_counted(capsys: Capture) -> None:
    numbers = Numbers(408, 412, tuple(msgspec.structs.replace(LIMIT, line=line) for line in (12, 13, 14, 15)))
    lines = shown(capsys, msgspec.structs.replace(RIGHT, folder="modelica/Arm", numbers=numbers, edited=("Arm.mo",)))
    assert lines[0].startswith("arm: differs: numbers differ (408 of 412); ")
    place, fault = (
        "  modelica/Arm/Joints/ElbowParameters.mo",
        "limits.effort of joint elbow is 150, and 130 in arm.urdf:34",
    )
    assert lines[1:5] == [
        f"{place}:12: {fault}; your edits are not the cause: check your own `templates`, or report a bug, with the "
        "source",
        f"{place}:13: {fault}",
        f"{place}:14: {fault} (and 1 more there)",
        "  Arm.mo (edited): its effect is not compared",
    ]


def test_one_robot_needs_no_tally(capsys: Capture) -> None:
    gap = "nothing was compiled: there is no Modelica Standard Library"
    result = CheckResult("arm", "Arm", unchecked=("poses were not compared",), gaps=(gap,), seconds=0.3)
    assert shown(capsys, result) == [
        "arm: incomplete: syntax and layout; 0.3 s",
        f"  {gap}",
        "not compared: poses were not compared",
    ]


def test_quiet_names_only_what_is_not_right(capsys: Capture) -> None:
    heads = [line.split(":")[0] for line in shown(capsys, *ALL, quiet=True) if not line.startswith(" ")]
    assert heads == ["welder", "picker", "cart", "new", "hoist", "lift"]
    assert shown(capsys, RIGHT, EDITED, quiet=True) == []
    assert shown(capsys, RIGHT, EDITED, quiet=True, strict=True)[0].startswith(
        "loader: differs: numbers right (411 of 412, 1 edited); 3 models compile"
    )


def test_verbose_lists_models_and_deviations(capsys: Capture) -> None:
    assert shown(capsys, EDITED, verbose=True)[4:-1] == [
        "  Arm: compiles",
        "  ArmRun: compiles",
        "  ArmTest: compiles",
        "  rigid bodies: relative differences of up to 2.0e-16 (link hand, position)",
        "  friction and gears: relative differences of up to 1.4e-15 (joint elbow, effort)",
        "  link hand: position differs by 2.4e-13 mm (2.0e-16)",
        "  link hand: orientation differs by 6.3e-15 ° (1.1e-16)",
        "  joint elbow: torque differs by 8.4e-14 N·m (1.4e-15)",
        "  joint wrist: torque differs by 4.2e-14 N·m (7.0e-16)",
        "  robot: mass differs by 0 kg (0.0e+00)",
        "  robot: centre of mass differs by 1.1e-13 mm (1.1e-16)",
        "  Joints/Elbow.mo (edited) changes the torque of joint elbow by 0.672 N·m",
    ]


# Sentences

ELBOW = load("joint elbow", 0.4, 12.5)
SHOULDER = load("joint shoulder", 0.3, 60.0)
HAND = Deviation(Quantity.POSITION, "link hand", 0.0123, 0.9, 1.2, "m")
TURNED = Deviation(Quantity.ORIENTATION, "link hand", math.sin(math.radians(3)), 1.0, 1.0, "")
BENT = Deviation(Quantity.POSITION, "link finger", 0.02, 1.1, 1.2, "m")
ROOT = Deviation(Quantity.REACTION, "link base", 7.5, 30.0, 30.0, "N")
MASS = Deviation(Quantity.MASS, "robot", 0.5, 25.0, 25.0, "kg")
PUSHED = Deviation(Quantity.ACCELERATION, "joint elbow", 6.42, 9.0, 9.0, "rad/s²", Aspect.FREE_MOTION)
BLIND = load("joint wheel", math.inf, 1.0)

AT_ELBOW = "the torque of joint elbow by 0.4 N·m"
AT_SHOULDER = "the torque of joint shoulder by 0.3 N·m"


def edited(capsys: Capture, effect: EditEffect) -> str:
    """What is said of edits."""
    _, sentence = shown(capsys, CheckResult("arm", "Arm", effects=(effect,)))
    return sentence.strip()


@pytest.mark.parametrize(
    ("files", "deviations", "said"),
    [
        (["a.mo"], [], "a.mo (edited) changes no compared motion or force"),
        (["a.mo", "b.mo"], [ELBOW], f"a.mo and b.mo (edited) together change {AT_ELBOW}"),
        (
            ["a.mo", "b.mo", "c.mo", "d.mo"],
            [HAND, TURNED, SHOULDER, ELBOW, MASS],
            "a.mo, b.mo and 2 more (edited) together change the position of link hand by 12.3 mm; "
            f"{AT_ELBOW} (also joint shoulder); the mass of robot by 0.5 kg",
        ),
        (["a.mo"], [BLIND], "a.mo (edited) changes the torque of joint wheel by more than any number"),
        (["a.mo"], [TURNED], "a.mo (edited) changes the orientation of link hand by 3 °"),
        # the free motion repeats no kind
        (
            ["a.mo"],
            [HAND, msgspec.structs.replace(HAND, part=Aspect.FREE_MOTION), PUSHED],
            "a.mo (edited) changes the position of link hand by 12.3 mm; "
            "the acceleration of joint elbow by 6.42 rad/s²",
        ),
    ],
)
def test_what_an_edit_does_is_one_sentence(
    capsys: Capture, files: list[str], deviations: list[Deviation], said: str
) -> None:
    assert edited(capsys, EditEffect(tuple(files), tuple(deviations))) == said


@pytest.mark.parametrize(
    ("owners", "deviations", "said"),
    [
        # the link that was edited, not the first that is displaced
        ((), [HAND, BENT], "the position of link hand by 12.3 mm (also link finger)"),
        (("link finger",), [HAND, BENT], "the position of link finger by 20 mm (also link hand)"),
        # the joint that was edited, not the last one; all joints before what holds the root
        ((), [ROOT, SHOULDER, ELBOW], f"{AT_ELBOW} (also joint shoulder and link base)"),
        (("joint shoulder",), [ROOT, SHOULDER, ELBOW], f"{AT_SHOULDER} (also joint elbow and link base)"),
    ],
)
def test_the_element_nearest_to_the_cause_comes_first(
    capsys: Capture, owners: tuple[str, ...], deviations: list[Deviation], said: str
) -> None:
    assert edited(capsys, EditEffect(("a.mo",), tuple(deviations), owners)) == f"a.mo (edited) changes {said}"


@given(st.floats(min_value=1e-6), st.floats(min_value=0, allow_infinity=False), st.sampled_from(Quantity))
def test_any_number_can_be_told(difference: float, value: float, quantity: Quantity) -> None:
    result = CheckResult("arm", "Arm", deviations=(Deviation(quantity, "it", difference, value, value, "N"),))
    show_result(Console(verbose=True), result)
