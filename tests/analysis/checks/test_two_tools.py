"""Two compilers: what is said when they agree with each other and with the reference, and who stands alone if not."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec
import pytest
from support.checks import status

from urdfsync.analysis.checks.compilation import compare_all
from urdfsync.analysis.checks.compilers.compiler import Tool
from urdfsync.analysis.checks.report import closing_lines, to_section
from urdfsync.analysis.checks.results import CheckResult, CheckStatus, CompiledModel, EditEffect, ToolResult
from urdfsync.analysis.checks.two_tools import run_both
from urdfsync.commands.check import show_result
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.domain.experiment import Compared, Experiment, Probe, Quantity, Trial
from urdfsync.output.console import Console

TOOLS = (Tool("rumoca"), Tool("omc"))
TITLES = {"rumoca": "rumoca 0.10.2", "omc": "OpenModelica 1.27.0"}
EXPERIMENT = Experiment(
    "Pinocchio 4.1.0",
    b"",
    None,
    (
        Trial(
            "motion",
            Probe("", "Probe", 1.0, 1.0, ("x", "tau")),
            (
                Compared(Quantity.POSITION, "link hand", "m", ("x",), (0.0, 1.0)),
                Compared(Quantity.EFFORT, "joint elbow", "N·m", ("tau",), (0.0, 1.0)),
            ),
            {"time": (0.0, 1.0), "x": (0.5, 0.75), "tau": (2.0, 4.0)},
        ),
    ),
)
EXPECTED = EXPERIMENT.trials[0].expected
LOST = Diagnostic(Severity.ERROR, "does-not-compile", "`elbo` is unknown", "Arm.mo", 7)

Numbers = Mapping[str, tuple[float, ...]]


class Said:
    """In the place of `Compilation`: a compiler that finds these numbers and says this."""

    def __init__(self, tool: Tool, numbers: Numbers, edited: Numbers, *said: Diagnostic) -> None:
        self.compiled: tuple[CompiledModel, ...] = (CompiledModel("Arm", 10),)
        times = {"time": (0.0, 1.0)}
        self.generated, self.edited = ({"motion": {**times, **some}} if some else {} for some in (numbers, edited))
        self.result = ToolResult(tool=TITLES[tool.name], diagnostics=said)

    def run(self, experiment: Experiment | None) -> None:
        """Fill the result."""
        self.result.compiled = self.compiled
        if experiment and self.generated:
            self.result.deviations = compare_all(experiment.trials, self.generated)


def check(
    numbers: Mapping[str, Numbers],
    edited: Mapping[str, Numbers] | None = None,
    said: Mapping[str, Diagnostic] | None = None,
) -> CheckResult:
    edited, said = edited or {}, said or {}
    first, second = (
        Said(
            tool,
            numbers[tool.name],
            edited.get(tool.name, {}),
            *(one for name, one in said.items() if name == tool.name),
        )
        for tool in TOOLS
    )
    result = CheckResult("arm", "Arm", reference=EXPERIMENT.reference)
    run_both(first, second, EXPERIMENT, result)  # type: ignore[arg-type]
    result.tools[0].seconds, result.tools[1].seconds = 12.0, 34.04
    return result


def lines(result: CheckResult, capsys: pytest.CaptureFixture[str]) -> list[str]:
    show_result(Console(), result)
    Console().tell(closing_lines([result]))
    return capsys.readouterr().out.splitlines()


def test_three_that_agree_are_right(capsys: pytest.CaptureFixture[str]) -> None:
    numbers = {"x": (0.5, 0.75), "tau": (2.0, 4.0 + 4.4e-15)}
    result = check({"rumoca": EXPECTED, "omc": numbers})
    assert status(result, strict=True) is CheckStatus.RIGHT
    assert lines(result, capsys) == [
        "arm: right: 1 model compiles; rigid bodies right; 0.0 s",
        "  rumoca 0.10.2 and OpenModelica 1.27.0 agree to 1.1e-15",
        "  rumoca 0.10.2: 12.0 s; OpenModelica 1.27.0: 34.0 s",
    ]


def test_details_name_the_compiler_and_a_finding_names_the_fault(capsys: pytest.CaptureFixture[str]) -> None:
    result = check({"rumoca": EXPECTED, "omc": EXPECTED})
    show_result(Console(verbose=True), result)
    details = [line.strip() for line in capsys.readouterr().out.splitlines()]
    assert {"Arm: compiles by rumoca 0.10.2", "Arm: compiles by OpenModelica 1.27.0"} < {*details}
    assert "joint elbow: torque differs by 0 N·m between the compilers" in details
    torque = msgspec.structs.replace((result.deviations or ())[1], difference=0.25)
    result.effects, result.strict = (EditEffect(("Elbow.mo",), (torque,)),), True
    assert (verdict := to_section(result).verdict)
    assert verdict.message == "Arm: Elbow.mo (edited) changes the torque of joint elbow by 0.25 N·m"


@pytest.mark.parametrize(("rumoca", "omc", "sentence"), [
    (4.5, 4.0, "joint elbow: torque: rumoca 0.10.2 stands alone, by 0.5 N·m"),
    (4.0, 4.5, "joint elbow: torque: OpenModelica 1.27.0 stands alone, by 0.5 N·m"),
    (4.5, 4.5, "joint elbow: torque: Pinocchio 4.1.0 stands alone, by 0.5 N·m"),
    (4.5, 5.0, "joint elbow: torque: all three differ, by up to 1 N·m"),
    (4.0, float("nan"), "joint elbow: torque: OpenModelica 1.27.0 stands alone, by more than any number"),
])  # fmt: skip
def test_who_stands_alone_is_named(
    rumoca: float, omc: float, sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    one, other = ({"x": (0.5, 0.75), "tau": (2.0, last)} for last in (rumoca, omc))
    result = check({"rumoca": one, "omc": other})
    assert status(result, strict=False) is CheckStatus.DIFFERS
    assert lines(result, capsys)[1] == f"  {sentence}"


def test_edits_that_two_compilers_understand_in_two_ways_are_a_difference(capsys: pytest.CaptureFixture[str]) -> None:
    """Such as a modifier that one of them ignores: then what is simulated is not what was written."""
    same = {"rumoca": EXPECTED, "omc": EXPECTED}
    result = check(same, {"rumoca": EXPECTED, "omc": {"x": (0.5, 0.75), "tau": (2.0, 4.25)}})
    assert status(result, strict=False) is CheckStatus.DIFFERS
    assert lines(result, capsys)[1:-1] == [
        "  joint elbow: with your edits, the torque by OpenModelica 1.27.0 "
        "differs from that by rumoca 0.10.2 by 0.25 N·m",
        "  rumoca 0.10.2 and OpenModelica 1.27.0 agree exactly",
    ]


def test_a_finding_of_both_is_said_once_and_one_of_one_alone_names_it() -> None:
    numbers = {"rumoca": EXPECTED, "omc": EXPECTED}
    elsewhere = msgspec.structs.replace(LOST, message="units do not fit", line=9)
    in_its_words = msgspec.structs.replace(LOST, message="Variable elbo not found")
    warning = msgspec.structs.replace(LOST, severity=Severity.WARNING)
    both = check(numbers, said={"rumoca": warning, "omc": in_its_words})
    assert [one.severity for one in both.diagnostics] == [Severity.WARNING, Severity.ERROR], "an error is never hidden"
    assert check(numbers, said={"rumoca": LOST, "omc": in_its_words}).diagnostics == (LOST,)
    alone = [one.message for one in check(numbers, said={"rumoca": LOST, "omc": elsewhere}).diagnostics]
    assert alone == [
        "only rumoca 0.10.2 reports: `elbo` is unknown",
        "only OpenModelica 1.27.0 reports: units do not fit",
    ]


def test_what_only_one_of_two_could_move_is_told_with_its_element(capsys: pytest.CaptureFixture[str]) -> None:
    result = check({"rumoca": {}, "omc": {"x": (0.5, 0.75), "tau": (2.0, 4.5)}})
    assert result.between is None
    assert lines(result, capsys)[1].startswith("  joint elbow: torque differs from Pinocchio 4.1.0 by 0.5 N·m")


def test_gaps_of_one_alone_name_it_and_models_compile_by_both() -> None:
    one, other = Said(TOOLS[0], EXPECTED, {}), Said(TOOLS[1], EXPECTED, {})
    one.compiled += (CompiledModel("Cell", 7, is_users=True),)
    one.result.gaps, other.result.gaps = ("both lack this", "a model"), ("both lack this",)
    other.compiled = (CompiledModel("Arm", 9),)
    other.result.failing = ("Cell",)
    result = CheckResult("arm", "Arm", gaps=("before",))
    run_both(one, other, None, result)  # type: ignore[arg-type]
    assert result.gaps == ("before", "both lack this", "rumoca 0.10.2: a model")
    assert (result.compiled, result.failing) == ((CompiledModel("Arm", 10),), ("Cell",))
    assert (result.between, result.deviations, result.tool) == (None, None, " and ".join(TITLES.values()))
