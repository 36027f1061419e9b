"""What people see of a check: a table on a wide terminal, steps on a narrow one, a line per robot in a pipe."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfsync.check import report
from urdfsync.check.results import CheckResult, CompiledModel, EditEffect
from urdfsync.commands.check import show_results
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import Deviation, Quantity
from urdfsync.output.console import Console

Capture = pytest.CaptureFixture[str]


def compiled(name: str, unknowns: int, states: int) -> tuple[CompiledModel, ...]:
    """As with `--physics`: the main model compiles as a part of the comparison, which tells no size."""
    return (
        CompiledModel(name, 0, 0),
        CompiledModel(f"{name}Run", unknowns, states),
        CompiledModel(f"{name}Test", unknowns, 0),
    )


def effort(element: str, difference: float, value: float) -> Deviation:
    return Deviation(Quantity.EFFORT, element, difference, value, 63.0, "N·m")


AGREEING = (
    Deviation(Quantity.POSITION, "link hand", 2.4e-16, 0.9, 1.2, "m"),
    Deviation(Quantity.ORIENTATION, "link hand", 1.1e-16, 1.0, 1.0, ""),
    effort("joint elbow", 8.4e-14, 21.0),
    effort("joint left_front_finger_knuckle_joint", 4.2e-14, 2.0),
    Deviation(Quantity.MASS, "robot", 0.0, 25.0, 25.0, "kg"),
    Deviation(Quantity.CENTRE, "robot", 1.1e-16, 0.3, 0.3, "m"),
)
BROKEN = Diagnostic(
    Severity.ERROR, "syntax", "the file does not end with `end Wheel;`", "modelica/Cart/Joints/Wheel.mo", 14
)
COPIES = "the models Run and Test (they are only compiled) and the record of the whole robot are not compared"
LIMITS = f"limits (they change no motion), {COPIES}"

RIGHT = CheckResult(
    "arm",
    "Arm",
    compiled=compiled("Arm", 1204, 12),
    deviations=AGREEING,
    notes=("inertias were made up for 3 links of the generated package only, because the file gives none",),
    unchecked=(LIMITS,),
    seconds=12.41,
    reference="Pinocchio 4.1.0",
)
EDITED = msgspec.structs.replace(
    RIGHT,
    robot="loader",
    notes=(),
    effects=(
        EditEffect(("Joints/Elbow.mo",), (effort("joint elbow", 0.672, 21.0),), ("joint elbow",)),
        EditEffect(("Links/Hand.mo",), (), ("link hand",)),
    ),
)
INCOMPLETE = msgspec.structs.replace(
    RIGHT,
    robot="welder",
    notes=(),
    gaps=("what edits do was not measured: `robot.hand.body.m` is not declared",),
)
WRONG = msgspec.structs.replace(
    RIGHT, robot="picker", notes=(), deviations=(*AGREEING, effort("joint mimic", 0.4, 12.5))
)
FAILED = CheckResult(
    "cart",
    "Cart",
    gaps=("nothing was compiled, since the files are not in order",),
    diagnostics=(BROKEN,),
    seconds=0.9,
)
ABSENT = msgspec.structs.replace(RIGHT, robot="new", notes=(), built=False, in_step=False)
STALE = msgspec.structs.replace(
    ABSENT,
    robot="hoist",
    built=True,
    gaps=("what edits do was not measured: the package is not in step with its source",),
)
TORN = msgspec.structs.replace(STALE, robot="lift", conflicting=True)
BRIEF = CheckResult(
    "arm",
    "Arm",
    unchecked=("poses and efforts were not compared: `--physics` does that",),
    gaps=("nothing was compiled: there is no Modelica Standard Library; put it on MODELICAPATH",),
    seconds=0.3,
)
ALL = (RIGHT, EDITED, INCOMPLETE, WRONG, FAILED, ABSENT, STALE, TORN)


def shown(
    capsys: Capture,
    *verdicts: CheckResult,
    strict: bool = False,
    quiet: bool = False,
    verbose: bool = False,
) -> list[str]:
    """The lines on the output stream."""
    capsys.readouterr()
    show_results(Console(quiet=quiet, verbose=verbose), verdicts, [one.robot for one in verdicts], strict)
    return [line.rstrip() for line in capsys.readouterr().out.splitlines()]


@pytest.fixture
def _terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    """A wide terminal without colours."""
    for name, value in {"FORCE_COLOR": "1", "NO_COLOR": "1", "COLUMNS": "108", "TERM": "xterm"}.items():
        monkeypatch.setenv(name, value)


# In a pipe


def test_a_line_for_each_robot_and_what_is_behind_it(capsys: Capture) -> None:
    agreement = "poses agree to 2.0e-16 (link hand); torques agree to 1.3e-15 (joint elbow); masses agree to 1.1e-16"
    size = "3 models compile; 1,204 equations = unknowns and 12 states in the largest"
    assert shown(capsys, *ALL) == [
        f"arm: right: {size}; {agreement}; 12.4 s",
        f"loader: right: {size}; {agreement}; 12.4 s",
        "  joint elbow: torque differs by 3.2 % since Joints/Elbow.mo was edited",
        "  Links/Hand.mo was edited; nothing that is compared changed",
        f"welder: incomplete: {size}; {agreement}; 12.4 s",
        "  what edits do was not measured: `robot.hand.body.m` is not declared",
        f"picker: differs: {size}; poses agree to 2.0e-16 (link hand); "
        "torques differ (joint mimic); masses agree to 1.1e-16; 12.4 s",
        "  joint mimic: torque differs from Pinocchio 4.1.0 by 3.2 %, 0.4 N·m where up to 12.5 N·m are expected",
        "cart: failed: 1 error; 0.9 s",
        "  nothing was compiled, since the files are not in order",
        f"new: not built: {size}; {agreement}; 12.4 s",
        "  there is no package yet, so what `urdfsync build` would write was checked",
        f"hoist: out of step: {size}; {agreement}; 12.4 s",
        "  what edits do was not measured: the package is not in step with its source",
        "  the package is not what a build would leave; run `urdfsync build`",
        f"lift: out of step: {size}; {agreement}; 12.4 s",
        "  what edits do was not measured: the package is not in step with its source",
        "  your edits and what is new contradict each other; settle that with `urdfsync resolve`",
        "differs: picker as generated, whatever you edited; look at `templates` of your own if there are some, else "
        "please report it as a bug, with the source",
        f"not checked: {LIMITS} (arm, loader and 5 more)",
        "for the comparison: inertias were made up for 3 links of the generated package only, because the file gives "
        "none (arm)",
        "8 robots: 2 right, 1 incomplete, 2 out of step, 1 not built, 1 differs, 1 failed",
    ]


def test_one_robot_needs_no_tally(capsys: Capture) -> None:
    assert shown(capsys, BRIEF) == [
        "arm: incomplete: syntax and layout; 0.3 s",
        "  nothing was compiled: there is no Modelica Standard Library; put it on MODELICAPATH",
        "not checked: poses and efforts were not compared: `--physics` does that",
    ]


def test_strict_makes_an_edit_a_difference(capsys: Capture) -> None:
    assert shown(capsys, EDITED, RIGHT, strict=True)[0].startswith("loader: differs: 3 models compile")
    lines = shown(capsys, EDITED, RIGHT, strict=True, quiet=True)
    assert [line.split(":")[0] for line in lines] == [
        "loader",
        "  joint elbow",
        "  Links/Hand.mo was edited; nothing that is compared changed",
    ]


def test_quiet_names_only_what_is_not_right(capsys: Capture) -> None:
    lines = shown(capsys, *ALL, quiet=True)
    heads = [line.split(":")[0] for line in lines if not line.startswith(" ")]
    assert heads == ["welder", "picker", "cart", "new", "hoist", "lift", "differs"]
    assert shown(capsys, RIGHT, EDITED, quiet=True) == []


def test_verbose_lists_models_and_deviations(capsys: Capture) -> None:
    lines = shown(capsys, EDITED, verbose=True)
    assert lines[3:-1] == [
        "  model    equations = unknowns  states",
        "  Arm                         –       –",
        "  ArmRun                  1,204      12",
        "  ArmTest                 1,204       0",
        "  element                                quantity          error   difference  of up to",
        "  link hand                              position        2.0e-16   2.4e-13 mm     0.9 m",
        "  link hand                              orientation     1.1e-16     6.3e-15°",
        "  joint elbow                            torque          1.3e-15  8.4e-14 N·m    21 N·m",
        "  joint left_front_finger_knuckle_joint  torque          6.7e-16  4.2e-14 N·m     2 N·m",
        "  robot                                  mass                  0         0 kg     25 kg",
        "  robot                                  centre of mass  1.1e-16   1.1e-13 mm     0.3 m",
        "  since Joints/Elbow.mo  quantity    error  difference  of up to",
        "  joint elbow            torque    1.1e-02   0.672 N·m    21 N·m",
    ]


# On a terminal


@pytest.mark.usefixtures("_terminal")
def test_a_wide_terminal_shows_a_table_as_on_the_page(capsys: Capture) -> None:
    page = (Path(__file__).parents[2] / "docs/checking.md").read_text(encoding="utf-8")
    *example, finding = page.partition("```text\n")[2].partition("```")[0].splitlines()
    assert finding == f"{BROKEN}"
    lines = shown(capsys, *ALL)
    assert lines[: len(example)] == example
    cells = example[2].removeprefix("✓ arm   ")
    unmeasured = "    what edits do was not measured: the package is not in step with its source"
    assert lines[len(example) :] == [
        f"! new   {cells}",
        "    there is no package yet, so what `urdfsync build` would write was checked",
        f"! hoist {cells}",
        unmeasured,
        "    the package is not what a build would leave; run `urdfsync build`",
        f"! lift  {cells}",
        unmeasured,
        "    your edits and what is new contradict each other; settle that with `urdfsync resolve`",
        "",
        "differs: picker as generated, whatever you edited; look at `templates` of your own if there are some, else",
        "please report it as a bug, with the source",
        "errors: largest difference from Pinocchio 4.1.0 relative to the largest value of its kind and unit, or to 1;",
        "up to 1e-10 agrees",
        "not checked: limits (they change no motion), the models Run and Test (they are only compiled) and the record",
        "of the whole robot are not compared (arm, loader and 5 more)",
        "for the comparison: inertias were made up for 3 links of the generated package only, because the file gives",
        "none (arm)",
        "8 robots: 2 right, 1 incomplete, 2 out of step, 1 not built, 1 differs, 1 failed",
    ]


@pytest.mark.usefixtures("_terminal")
def test_a_narrow_terminal_shows_step_by_step(capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "60")
    assert shown(capsys, WRONG) == [
        "≠ picker: differs, 12.4 s",
        "    3 models compile",
        "    1,204 equations = unknowns and 12 states in the largest",
        "    poses agree to 2.0e-16 (link hand)",
        "    torques differ (joint mimic)",
        "    masses agree to 1.1e-16",
        "    joint mimic: torque differs from Pinocchio 4.1.0 by 3.2",
        "    %, 0.4 N·m where up to 12.5 N·m are expected",
        "",
        "differs: picker as generated, whatever you edited; look at",
        "`templates` of your own if there are some, else please",
        "report it as a bug, with the source",
        "not checked: limits (they change no motion), the models Run",
        "and Test (they are only compiled) and the record of the",
        "whole robot are not compared",
    ]


@pytest.mark.usefixtures("_terminal")
@pytest.mark.parametrize("width", [40, 66, 100, 200])
def test_no_line_is_wider_than_the_terminal(capsys: Capture, monkeypatch: pytest.MonkeyPatch, width: int) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    lines = shown(capsys, *ALL)
    assert max(map(len, lines)) <= width
    assert max(map(len, shown(capsys, *ALL, verbose=True))) <= max(width, 60)


@pytest.mark.usefixtures("_terminal")
def test_rows_come_one_by_one(capsys: Capture) -> None:
    def found() -> Iterator[CheckResult]:
        yield RIGHT
        first = capsys.readouterr().out.splitlines()
        assert first[1].startswith("  robot               compile")
        yield msgspec.structs.replace(RIGHT, robot="a_much_longer_name")
        (second,) = capsys.readouterr().out.splitlines()
        assert second.startswith("✓ a_much_longer_name        3")

    show_results(Console(), found(), ["arm", "a_much_longer_name"], strict=False)


def test_colours_are_for_terminals_that_want_them(capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("COLUMNS", "120")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.delenv("NO_COLOR", raising=False)
    assert any("\x1b[32m✓" in line for line in shown(capsys, RIGHT))
    assert any("\x1b[35m?" in line for line in shown(capsys, INCOMPLETE))
    monkeypatch.setenv("NO_COLOR", "1")
    assert not any("\x1b[3" in line for line in shown(capsys, RIGHT))


# Sentences


def load(element: str, difference: float, value: float, unit: str = "N·m") -> Deviation:
    return Deviation(Quantity.EFFORT, element, difference, value, 60.0, unit)


ELBOW = load("joint elbow", 0.4, 12.5)
SHOULDER = load("joint shoulder", 0.3, 60.0)
WRIST = load("joint wrist", 0.02, 1.0)
ROLL = load("joint roll", 0.01, 0.5)
HAND = Deviation(Quantity.POSITION, "link hand", 0.0123, 0.9, 1.2, "m")
TURNED = Deviation(Quantity.ORIENTATION, "link hand", math.sin(math.radians(3)), 1.0, 1.0, "")
BENT = Deviation(Quantity.POSITION, "link finger", 0.02, 1.1, 1.2, "m")
REACTIONS = [
    Deviation(Quantity.REACTION, "link base", 7.5, 30.0, 30.0, "N"),
    Deviation(Quantity.REACTION, "link base", 0.168, 12.0, 12.0, "N·m"),
]
MASS = Deviation(Quantity.MASS, "robot", 0.5, 25.0, 25.0, "kg")
CENTRE = Deviation(Quantity.CENTRE, "robot", 0.0385, 0.3, 0.3, "m")
BLIND = Deviation(Quantity.ACCELERATION, "link wheel", math.inf, 1.0, 1.0, "rad/s²")


def edit(*deviations: Deviation, files: Sequence[str] = ("a.mo",), owners: tuple[str, ...] = ()) -> str:
    return report.effect(EditEffect(tuple(files), deviations, owners))


@pytest.mark.parametrize(
    ("found", "said"),
    [
        (load("joint elbow", 6.0, 12.5), "48 %"),
        (load("joint elbow", 1e-9, 12.5), "less than 0.001 %"),
        (load("joint elbow", 0.4, 1e-14), "0.4 N·m"),
        (load("joint slide", 20.0, 0.0, "N"), "20 N"),
        (HAND, "12.3 mm"),
        (Deviation(Quantity.CENTRE, "robot", 1.2345, 2.0, 2.0, "m"), "1.23 m"),
        (Deviation(Quantity.ORIENTATION, "link hand", 2.0, 1.0, 1.0, ""), "180°"),
    ],
)
def test_amounts_are_in_percent_where_that_says_something(found: Deviation, said: str) -> None:
    assert edit(found).endswith(f" differs by {said} since a.mo was edited")


@given(st.floats(min_value=1e-6, allow_nan=False), st.floats(min_value=0, allow_nan=False, allow_infinity=False))
def test_no_percentage_is_absurd(difference: float, value: float) -> None:
    said = edit(load("joint elbow", difference, value)).partition(" since")[0]
    number, unit = said.split()[-2:]
    assert unit in ("%", "N·m", "finite")
    assert unit != "%" or "less than" in said or 0.001 <= float(number) < 1000


L = [f"Links/L{number}.mo" for number in range(12)]


@pytest.mark.parametrize(
    ("files", "deviations", "said"),
    [
        (["Links/Hand.mo"], [], "Links/Hand.mo was edited; nothing that is compared changed"),
        (
            ["a.mo", "b.mo", "c.mo", "d.mo", "e.mo"],
            [SHOULDER, ELBOW, WRIST, ROLL],
            "joint roll: torque differs by 2 % (also joint wrist, joint elbow and joint shoulder) since "
            "a.mo, b.mo and 3 more were edited",
        ),
        (
            ["Joints/Elbow.mo"],
            [HAND, TURNED, ELBOW, MASS],
            "link hand: position differs by 12.3 mm and orientation differs by 3°; joint elbow: torque differs by "
            "3.2 %; robot: mass differs by 2 % since Joints/Elbow.mo was edited",
        ),
        (
            ["a.mo"],
            [BLIND, ELBOW],
            "joint elbow: torque differs by 3.2 % (also link wheel) since a.mo was edited",
        ),
        (
            L,
            [HAND, ELBOW],
            "link hand: position differs by 12.3 mm; joint elbow: torque differs by 3.2 % since Links/L0.mo, "
            "Links/L1.mo and 10 more were edited",
        ),
        (L[:7], [], "Links/L0.mo, Links/L1.mo and 5 more were edited; nothing that is compared changed"),
    ],
)
def test_what_an_edit_does_is_one_sentence(files: list[str], deviations: list[Deviation], said: str) -> None:
    assert edit(*deviations, files=files) == said


@pytest.mark.parametrize(
    ("owners", "deviations", "said"),
    [
        # the link that was edited, not the first that is displaced
        ((), [HAND, BENT], "link hand: position differs by 12.3 mm (also link finger)"),
        (("link finger",), [HAND, BENT], "link finger: position differs by 20 mm (also link hand)"),
        # the joint that was edited, not the last one; all joints before what holds the root
        (
            (),
            [*REACTIONS, SHOULDER, ELBOW],
            "joint elbow: torque differs by 3.2 % (also joint shoulder and link base)",
        ),
        (
            ("joint shoulder",),
            [*REACTIONS, SHOULDER, ELBOW],
            "joint shoulder: torque differs by 0.5 % (also joint elbow and link base)",
        ),
        ((), [BLIND, *REACTIONS], "link wheel: angular acceleration is not finite (also link base)"),
    ],
)
def test_the_element_nearest_to_the_cause_comes_first(
    owners: tuple[str, ...], deviations: list[Deviation], said: str
) -> None:
    assert edit(*deviations, owners=owners) == f"{said} since a.mo was edited"


@pytest.mark.parametrize(
    ("deviations", "said", "sentences"),
    [
        (
            [HAND, SHOULDER, ELBOW],
            "poses differ (link hand); torques differ (joint elbow)",
            [
                "link hand: position differs from Pinocchio 4.1.0 by 12.3 mm",
                "joint elbow: torque differs from Pinocchio 4.1.0 by 3.2 %, 0.4 N·m where up to 12.5 N·m are expected "
                "(also joint shoulder)",
            ],
        ),
        (
            [*REACTIONS, MASS, CENTRE],
            "torques differ (link base); masses differ",
            [
                "link base: reaction force differs from Pinocchio 4.1.0 by 25 %, 7.5 N where up to 30 N are expected "
                "and reaction torque differs from Pinocchio 4.1.0 by 1.4 %, 0.168 N·m where up to 12 N·m are expected",
                "robot: mass differs from Pinocchio 4.1.0 by 2 %, 0.5 kg where up to 25 kg are expected and centre of "
                "mass differs from Pinocchio 4.1.0 by 38.5 mm",
            ],
        ),
        (
            [BLIND],
            "torques differ (link wheel)",
            ["link wheel: angular acceleration is not finite"],
        ),
        ([msgspec.structs.replace(MASS, difference=0)], "masses agree exactly", []),
    ],
)
def test_a_difference_is_told_in_short_and_at_length(
    capsys: Capture, deviations: list[Deviation], said: str, sentences: list[str]
) -> None:
    found = CheckResult("arm", "Arm", compiled=compiled("Arm", 0, 0)[:1], deviations=tuple(deviations))
    found.reference = "Pinocchio 4.1.0"
    head, *lines = shown(capsys, found)
    assert head == f"arm: {'differs' if sentences else 'right'}: 1 model compiles; {said}; 0.0 s"
    assert [line.strip() for line in lines if line.startswith(" ")] == sentences


GAP = "what edits do was not measured: the robot can't be simulated"


@pytest.mark.parametrize(
    ("facts", "strict", "word"),
    [
        ({"gaps": (GAP,)}, True, "incomplete"),
        ({"gaps": (GAP,), "in_step": False}, False, "out of step"),
        ({"in_step": False, "built": False}, False, "not built"),
        ({"effects": (EditEffect(("a.mo",), (ELBOW,)),)}, False, "right"),
        ({"effects": (EditEffect(("a.mo",), (ELBOW,)),), "gaps": (GAP,)}, True, "differs"),
        ({"deviations": (ELBOW,), "in_step": False}, False, "differs"),
    ],
)
def test_one_word_for_all(facts: dict[str, Any], strict: bool, word: str) -> None:
    assert report.summary(CheckResult("arm", "Arm", **facts), strict).startswith(f"{word}: ")
