"""The comparison of one robot: what is generated with the reference, and what is edited with what is generated."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

from urdfsync.check.compilers.compiler import CompileTask, Simulation
from urdfsync.check.package import CheckedPackage
from urdfsync.check.results import EditEffect, agrees
from urdfsync.config import shown
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import Deviation, Experiment

Series: TypeAlias = Mapping[str, Sequence[float]]
"""Values over time by the names of variables."""

_UNEXPLAINED = 0.01
"""Part of a change that single edits must leave unexplained before it is told as one of several together."""


def experiment(package: CheckedPackage, complete: bool) -> Experiment:
    """The experiment for a package: with the source as it is, or `complete`. Raises UrdfsyncError if there is none."""
    robot, content = package.robot, package.rendering.content
    found = package.domain.experiment(content, shown(robot.source), robot.target, robot.options, complete)
    if found is None:
        message = "nothing can be compared: there is no reference for this package"
        raise OutputError(Diagnostic(Severity.ERROR, "no-reference", message, hint="check without `--physics`"))
    return found


def moving_task(experiment: Experiment) -> CompileTask:
    """The task that moves a package as the experiment wants."""
    probe = experiment.probe
    run = Simulation(probe.stop, probe.step)
    return CompileTask(probe.model, probe.source, (run,), probe.values, title="the comparison")


def find_effects(
    package: CheckedPackage, plain: Experiment, baseline: Series, edited: Series, single: Mapping[str, Series]
) -> Iterator[EditEffect]:
    """What each edit changes: all series are of the `plain` experiment, `single` of packages with one edit each."""
    files = package.meaningful_edits
    whole = plain.compare(edited, baseline)
    apart = {file: plain.compare(series, baseline) for file, series in single.items()}
    rest = plain.compare(unexplained(baseline, edited, list(single.values())), baseline)
    owners = package.files.owners
    for one in edit_effects(files, whole, apart, rest):
        yield EditEffect(one.files, one.deviations, tuple(dict.fromkeys(owners[file] for file in one.files)))


def unexplained(baseline: Series, edited: Series, single: Sequence[Series]) -> Series:
    """The simulation in which everything has happened but what each single edit does: what they do only together."""
    return {
        name: [
            base + (value - base) - sum(one[name][instant] - base for one in single)
            for instant, (base, value) in enumerate(zip(values, edited[name], strict=True))
        ]
        for name, values in baseline.items()
        if all(len(series.get(name, ())) == len(values) for series in (edited, *single))
    }


def edit_effects(
    files: Sequence[str],
    whole: Sequence[Deviation],
    single: Mapping[str, Sequence[Deviation]],
    rest: Sequence[Deviation],
) -> list[EditEffect]:
    """What the edits in `files` do, each apart where that can be told, in their order.

    All deviations are from the generated package: `whole` of the one on disk, `single` of those with one edit each,
    `rest` of what none of these explains.
    """
    changes = [one for one in whole if not agrees(one)]
    if len(files) == 1:
        return [EditEffect((files[0],), tuple(changes))]
    left = {(one.quantity, one.element, one.unit): one.difference for one in rest if not agrees(one)}
    together = tuple(
        one
        for one in changes
        if not left.get((one.quantity, one.element, one.unit), 0.0) <= _UNEXPLAINED * one.difference
    )
    apart = [
        EditEffect((file,), tuple(one for one in single[file] if not agrees(one))) for file in files if file in single
    ]
    untried = tuple(file for file in files if file not in single)
    if not together:
        return [*apart, *([EditEffect(untried, ())] if untried else [])]
    effective = [effect for effect in apart if effect.deviations]
    told = {effect.files[0] for effect in effective}
    return [*effective, EditEffect(tuple(file for file in files if file not in told) or tuple(files), together)]
