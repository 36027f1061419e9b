"""Which edit changes the motion: the effect of each is what goes away when it alone is taken back."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from pathlib import Path
from random import Random
from typing import NamedTuple

import pytest
from support.cases import CASES
from support.two_joints import check, codes, replace

from urdfsync.analysis.checks import libraries
from urdfsync.analysis.checks.compilers.compiler import CompileJob, CompileResult, CompileTask, SimulationResult
from urdfsync.analysis.checks.results import CheckResult
from urdfsync.domain.experiment import Quantity

ROBOT, ELBOW = "Arm.mo", "Joints/Elbow.mo"
HAND, LINK, SHOULDER_NUMBERS, ELBOW_NUMBERS = (
    *("Links/HandParameters.mo", "Links/Arm_link_be5539Parameters.mo"),
    *("Joints/ShoulderParameters.mo", "Joints/ElbowParameters.mo"),
)
SENSOR = "  Modelica.Mechanics.MultiBody.Sensors.AbsoluteSensor imu(get_a = true);\n"


class Edit(NamedTuple):
    """One edit of a file; `{}` in the new text is a random number."""

    file: str
    old: str
    new: str
    changes: Collection[tuple[Quantity, str]] = ()
    """Quantities of elements that the edit changes for certain."""
    may_change: Collection[Quantity] = ()
    """Further quantities that the edit may change."""


DYNAMICS = Quantity.EFFORT, Quantity.REACTION, Quantity.ACCELERATION
WEIGHT = *DYNAMICS, Quantity.MASS, Quantity.CENTRE
PLACE = *DYNAMICS, Quantity.POSITION, Quantity.ORIENTATION, Quantity.CENTRE
EDITS = (
    Edit(HAND, "mass = 0.7", "mass = 0.9{}", {(Quantity.MASS, "robot"), (Quantity.EFFORT, "joint elbow")}, WEIGHT),
    Edit(LINK, "mass = 2", "mass = 2.{}", {(Quantity.MASS, "robot"), (Quantity.EFFORT, "joint shoulder")}, WEIGHT),
    Edit(
        LINK, "{0.02, -0.05, 0.1}", "{{0.02, 0.0{}, 0.1}}", {(Quantity.CENTRE, "robot")}, (*DYNAMICS, Quantity.CENTRE)
    ),
    Edit(HAND, "ixx = 0.0147", "ixx = 0.02{}", {(Quantity.EFFORT, "joint elbow")}, DYNAMICS),
    Edit(ELBOW_NUMBERS, "damping = 0.1", "damping = 0.2{}", {(Quantity.EFFORT, "joint elbow")}, DYNAMICS),
    Edit(SHOULDER_NUMBERS, "damping = 0.5", "damping = 0.8{}", {(Quantity.EFFORT, "joint shoulder")}, DYNAMICS),
    Edit(ELBOW_NUMBERS, "{0.1, -0.2, 0.3}", "{{0.1, -0.2, 0.4{}}}", {(Quantity.POSITION, "link hand")}, PLACE),
    Edit(SHOULDER_NUMBERS, "{0.1, -0.2, 0.3}", "{{0.2{}, -0.2, 0.3}}", {(Quantity.POSITION, "link arm")}, PLACE),
    # the support turns, so that the axis has another torque: a spring inside of the joint
    Edit(
        ELBOW,
        "\nequation\n",
        "\n  Modelica.Mechanics.Rotational.Components.Spring spring(c = 1.{});\nequation\n"
        "  connect(spring.flange_a, revolute.support);\n  connect(spring.flange_b, revolute.axis);\n",
        {(Quantity.EFFORT, "joint elbow")},
        DYNAMICS,
    ),
    Edit(ROBOT, "\nequation\n", f"\n{SENSOR}equation\n  connect(imu.frame_a, hand.frame_a);\n"),
    Edit("Links/Hand.mo", "\nequation\n", "\n  Real looked = 1.{};\nequation\n"),
    Edit("Joints/Shoulder.mo", "\nequation\n", "\n  Real moved = 3.{}*axis.tau;\nequation\n"),
    Edit("Links/Base.mo", "\nequation\n", "\n  parameter Real unused = 1.{};\nequation\n"),
)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(CASES or 4))
def test_the_blamed_edit_is_the_right_one(arm: Path, modelica_library: Path, seed: int) -> None:
    """Two or three random edits, of different files, change what they would change alone, and nothing else."""
    random = Random(f"{seed}")
    by_file = {edit.file: edit for edit in random.sample(EDITS, len(EDITS))}
    edits = random.sample(list(by_file.values()), random.choice((2, 3)))
    for edit in edits:
        replace(arm / edit.file, edit.old, edit.new.format(random.randrange(1, 99)))
    result = check(physics=True)
    assert (codes(result), result.gaps, result.uncompared_edits) == ([], (), ())
    for edit in edits:
        (effect,) = (effect for effect in result.effects if edit.file in effect.files)
        changes = {(each.quantity, each.element) for each in effect.deviations}
        assert changes >= set(edit.changes), edit
        assert {quantity for quantity, _ in changes} <= {*edit.may_change}, edit
        assert effect.files == (edit.file,) or not effect.deviations, "no edit is blamed for another"


class Numbers:
    """Replace `compilers.run_job`: the motions of a robot whose mass is the sum of all masses in its texts.

    The free motion depends on damping, too. A text that uses the name `extra`, which no text declares, is refused.
    """

    def __call__(self, tool: object, job: CompileJob, *_: object, **__: object) -> list[CompileResult]:
        """Return a result for each task."""
        texts = {path.name: path.read_text() for path in Path(job.roots[-1]).rglob("*.mo")}
        return [self._answer(task, texts) for task in job.tasks]

    def _answer(self, task: CompileTask, texts: Mapping[str, str]) -> CompileResult:
        every = "".join(texts.values())
        if "extra + " in every and "Real extra" not in every:
            return CompileResult("`extra` is not declared")
        # the robot overrides the mass in the record of the hand
        masses = {name: re.findall(r"\bmass = ([\d.]+)", text) for name, text in texts.items()}
        masses["HandParameters.mo"] = masses["Arm.mo"] or masses.get("HandParameters.mo", [])
        mass = sum(float(number) for name, numbers in masses.items() if name != "Arm.mo" for number in numbers)
        mass += every.count("Real vote") > 1
        damping = sum(map(float, re.findall(r"\bdamping = ([\d.]+)", every)))
        is_free, runs = "free" in task.title, list[SimulationResult]()
        value = mass + damping if is_free else mass
        for run in task.runs:
            times = tuple(k * run.step for k in range(round(run.stop / run.step) + 1))
            names = *task.values, *task.pattern.replace("\\", "").split("|")
            series = {
                name: (value if re.fullmatch(r"mass|gain\d|.*\.a", name) else 0.0,) * len(times) for name in names
            }
            runs.append(SimulationResult({"time": times, **series}))
        return CompileResult(unknowns=7, runs=tuple(runs))


@pytest.fixture
def numbers(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """A stand-in for the compiler, which takes no time."""
    monkeypatch.setattr("urdfsync.analysis.checks.compilers.run_job", Numbers())
    monkeypatch.setattr(libraries, "copy_named", lambda *_: tmp_path)
    monkeypatch.setattr("platformdirs.user_cache_path", lambda *_, **__: tmp_path / "cache")


HEAVY, LIGHT = (HAND, "mass = 0.7", "mass = 0.9"), (LINK, "mass = 2", "mass = 1")
OVERRIDE = ROBOT, "replaceable Links.Hand hand(", "replaceable Links.Hand hand(parameters(inertial(mass = 0.9)), "
DAMPED = ELBOW_NUMBERS, "damping = 0.1", "damping = 0.3"
UNUSED = "Links/Hand.mo", "\nequation\n", "\n  Real looked = 1;\nequation\n"
VOTE = "Links/Hand.mo", "\nequation\n", "\n  Real vote = 1;\nequation\n"
MASS, GAIN, NONE = {Quantity.MASS, Quantity.ACCELERATION}, {Quantity.ACCELERATION}, set[Quantity]()
FIXED: dict[str, tuple[list[tuple[str, str, str]], dict[tuple[str, ...], set[Quantity]]]] = {
    # the free motion, too, belongs to the edit of the mass
    "a mass and a sensor": ([HEAVY, UNUSED], {(HAND,): MASS, ("Links/Hand.mo",): NONE}),
    "a mass alone": ([HEAVY], {(HAND,): MASS}),
    "two masses and a damping": ([HEAVY, LIGHT, DAMPED], {(HAND,): MASS, (LINK,): MASS, (ELBOW_NUMBERS,): GAIN}),
    "one hides the other": ([(HAND, "mass = 0.7", "mass = 0.8"), OVERRIDE], {(ROBOT,): MASS, (HAND,): NONE}),
    "both say the same": (
        [HEAVY, OVERRIDE, DAMPED], {(ROBOT, HAND, ELBOW_NUMBERS): {Quantity.MASS}, (ELBOW_NUMBERS,): GAIN},
    ),
    # any two of three: neither one alone, nor all but one
    "no single one": ([VOTE, *((file, *VOTE[1:]) for file in ("Links/Base.mo", ELBOW))], {
        (ELBOW, "Links/Base.mo", "Links/Hand.mo"): MASS,
    }),
    "one needs the other": (
        [("Links/Base.mo", "\nequation\n", "\n  Real extra = 1;\nequation\n"),
         (HAND, "mass = 0.7", "mass = 0.9 /* extra + */")],
        {(HAND,): MASS},
    ),
}  # fmt: skip


def effects(result: CheckResult) -> dict[tuple[str, ...], set[Quantity]]:
    return {effect.files: {each.quantity for each in effect.deviations} for effect in result.effects}


@pytest.mark.parametrize(("edits", "expected"), FIXED.values(), ids=FIXED)
def test_each_edit_has_what_goes_away_with_it(
    arm: Path,
    modelica_library: Path,
    numbers: None,
    edits: list[tuple[str, str, str]],
    expected: dict[tuple[str, ...], set[Quantity]],
) -> None:
    for file, *texts in edits:
        replace(arm / file, *texts)
    found = effects(check(physics=True))
    assert {tuple(sorted(files)): own for files, own in found.items()} == {
        tuple(sorted(files)): own for files, own in expected.items()
    }
