"""Compares a log with a robot's package, and fits the numbers of its records to the log."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path

import msgspec
import numpy as np

from urdfsync.analysis.checks.results import JointFit, Judgement
from urdfsync.analysis.identification import signals
from urdfsync.analysis.identification.fit import SURE, Evidence, Fit, LeastSquares, fit, is_body, sure_places
from urdfsync.analysis.identification.gains import VISIBLE, find_gains
from urdfsync.analysis.identification.log import Log
from urdfsync.analysis.identification.records import Records, read_records
from urdfsync.analysis.identification.results import (
    EffortSeries,
    Excitation,
    FittedNumber,
    Identification,
    IdentifyOptions,
    Unexcited,
)
from urdfsync.common.diagnostics import ConfigError, Diagnostic, Severity, SourceError
from urdfsync.common.files import shown
from urdfsync.common.spelling import nearest
from urdfsync.domain.regressor import NUMBERS, QUANTITIES, Array, MovingLink, Regressor
from urdfsync.engine.options import Progress
from urdfsync.project.config import Config, RobotConfig

_STORED = 3_000_000
"""So many numbers of samples remain in memory: for the plot, and to see how alike neighbouring residuals are."""

_DOUBTFUL = 0.5
"""The unexplained share of an effort from which on the log is hardly that of the robot."""
_GAIN = 1.45
"""A factor of all efforts that the source hardly explains; masses and frictions are wrong by so much."""
_STATED_GAIN = 3.0
"""Likewise, if the log states the unit of its efforts."""
_HUGE = 100.0
"""A factor that a note does not state: an effort that has nothing in common with the others shows none."""
_HINT = "look for another sign, unit or joint in the log"
_CONSIDERABLE = 0.05
"""In the greatest effort of a joint: a smaller effort may be that of a sensor's offset."""
_USUAL_DELAY = 0.005
"""In s: a longer delay needs evidence, since in slow motions damping looks much like a delay."""
_USUAL_OFFSET = 0.02
"""Of a sensor, in root mean squares of the effort: in a small range, an offset looks much like gravity."""


class Measured:
    """A log against a model: the evidence of all samples, and some of the samples."""

    def __init__(self, regressor: Regressor, file: Path, options: IdentifyOptions, progress: Progress) -> None:
        """Raises UrdfsyncError for a log that can't be used."""
        _check_axes(regressor)
        self.regressor, self.log = regressor, Log(file, regressor.axes, options)
        self.axes = [regressor.axes[k] for k in self.log.measured]
        self.parameters = 10 * len(regressor.bodies) + len(regressor.losses)
        self.evidence, self.held_out, self.unused = (Evidence(len(self.axes)) for _ in range(3))
        self.sizes = np.full((3, len(self.axes)), 1e-12)
        """The greatest speed, 1 and acceleration of each axis, as damping, dry friction and inertia act on them."""
        self.seconds = self.rate = 0.0
        self._stored: list[tuple[Array, Array, np.ndarray]] = []
        # two passes: where a robot rests or a log has gaps, a piece does not tell how fast the motion is
        self.cutoff = options.cutoff or signals.find_cutoff(self.log.pieces(), regressor.axes, self.log.measured)
        self.log.dropped.clear()
        first, last, total = 0.0, -np.inf, 0
        for number, piece in enumerate(self.log.pieces()):
            first = first if number else piece.times[0]
            last, total = max(last, piece.times[-1]), total + len(piece.times)
            progress("reading the log", total, 0)
            self.rate = self.rate or (len(piece.times) - 1) / (piece.times[-1] - piece.times[0])
            if self.cutoff >= self.rate / 2:
                message = f"a cut-off frequency of {self.cutoff:g} Hz is too high for {self.rate:.4g} rows per second"
                raise ConfigError.of("log", message, shown(file), hint="leave `--cutoff` out")
            samples = signals.prepare(piece, regressor.axes, self.cutoff)
            if samples is None:
                self.log.dropped["row in a piece that is too short for the filter"] += len(piece.times)
                continue
            self.seconds += piece.times[-1] - piece.times[0]
            self._add(samples, first + (np.inf if options.until is None else options.until))
        self.end = float(last - first)
        if not self.evidence.counts.any() and self.held_out.counts.any():
            message = f"`--until {options.until:g}` leaves too little of {shown(file)} to fit"
            raise ConfigError.of("log", message, hint="give a later time, or leave it out")
        if not self.evidence.counts.any():
            message = f"{shown(file)} has no sample that can be fitted: {'; '.join(self.told()) or 'no rows'}"
            raise SourceError.of("log", message, hint="the joints have to move for a few seconds without a gap")

    def _add(self, samples: signals.Samples, end: float) -> None:
        derivatives, model = self.regressor.rows(samples.q, samples.v, samples.a)
        chosen = self.log.measured
        places, derivatives, model = signals.thinned(samples, self.cutoff, derivatives[:, chosen], model[:, chosen])
        times, is_free = samples.times[places], samples.is_free[places][:, chosen]
        self.sizes[0] = np.maximum(self.sizes[0], np.abs(samples.v[:, chosen]).max(axis=0))
        self.sizes[2] = np.maximum(self.sizes[2], np.abs(samples.a[:, chosen]).max(axis=0))
        self.sizes[1] = 1.0
        offsets = np.broadcast_to(np.eye(len(chosen)), (len(places), len(chosen), len(chosen)))
        efforts = np.moveaxis(samples.efforts[:, places][:, :, chosen], 0, 2)
        rows = np.concatenate([derivatives, offsets, efforts, model[:, :, None]], axis=2)
        for j in range(len(chosen)):
            early = is_free[:, j] & (times < end)
            self.evidence.add(j, rows[early, j])
            self.held_out.add(j, rows[is_free[:, j] & (times >= end), j])
            self.unused.add(j, rows[~is_free[:, j], j])
        if sum(block.size for _, block, _ in self._stored) + rows.size < _STORED or not self._stored:
            self._stored.append((times, rows, is_free))

    def at(self, target: Array) -> Array:
        """Return a combination of efforts, and of the model's, as one of all columns."""
        return np.concatenate([np.zeros(self.parameters + len(self.axes)), target])

    def joint_fits(self, evidence: Evidence, target: Array, delta: Array) -> tuple[JointFit, ...]:
        """Return how well the model explains each joint, before and after a change of its parameters."""
        measured = target.copy()
        measured[-1] = 0.0
        rows, left = [], np.concatenate([delta, -target])
        for j, axis in enumerate(self.axes):
            if count := int(evidence.counts[j]):
                parts = self.at(measured), self.at(target), left
                whole, before, after = (math.sqrt(evidence.squares(j, part) / count) for part in parts)
                unit, offset = "N·m" if axis.unit == "rad" else "N", float(delta[self.parameters + j])
                rows.append(JointFit(f"joint {axis.name}", unit, whole, before, after, offset, count))
        return tuple(rows)

    def series(self, target: Array, delta: Array) -> EffortSeries:
        """Return the stored samples."""
        times, rows, is_free = (np.concatenate(parts) for parts in zip(*self._stored, strict=True))
        count = len(delta)
        measured, model = rows[:, :, count:-1] @ target[:-1], rows[:, :, -1]
        return EffortSeries(times, measured, model, model + rows[:, :, :count] @ delta, is_free)

    def doubts(self, options: IdentifyOptions) -> Iterator[Diagnostic]:
        """Yield a warning for what is not in the log, and for limits that it passes."""
        if options.until is not None and not self.held_out.counts.any():
            message = f"`--until {options.until:g}` holds nothing out: the log has no sample after that time"
            hint = f"its last time is {self.end:.4g} s after its first"
            again = ", and its times begin anew: give it as two logs" if self.log.dropped["reset of the time"] else ""
            yield Diagnostic(Severity.WARNING, "identify", message, hint=hint + again)
        fitted = {axis.name for axis, count in zip(self.axes, self.evidence.counts, strict=True) if count}
        for axis in self.regressor.axes:
            if axis.name not in fitted:
                why = "stands still, or its effort is constant" if axis in self.axes else "is not in the log"
                yield Diagnostic(Severity.WARNING, "identify", f"joint {axis.name}: it {why}, so it can't be fitted")
        yield from self.log.doubts()

    def told(self) -> tuple[str, ...]:
        """Return what was left out of the log, in words."""
        held, counts = int(self.unused.counts.sum()), self.evidence.counts + self.held_out.counts
        words = f"{held} filtered samples of joints that stand still, or whose effort is constant or at its limit"
        still = [axis.name for axis, count in zip(self.axes, counts, strict=True) if not count]
        words += f": all of {', '.join(still)}" if still else ""
        return (*self.log.told(), *([words] if held else []))


def identify(
    config: Config, robot: RobotConfig, log: Path, options: IdentifyOptions, progress: Progress, *, write: bool
) -> Identification:
    """Fit a robot's records to a log, and write the records if asked to. Raises UrdfsyncError."""
    records = read_records(config, robot, options.wait)
    regressor = records.regressor()
    measured = Measured(regressor, log, options, progress)
    _check_names(options, regressor)
    problem, fitted, notes = _problem(regressor, measured, records, options)
    before, first = _fitted(problem, measured, _of_log(problem)), _fitted(problem, measured, fitted)
    found = [
        *_doubts(_joints(measured, measured.evidence, before, first)),
        *_log_doubts(problem, measured, float(before.after[-1])),
    ]
    doubts = [finding for finding in found if finding.severity is Severity.ERROR]
    sure, result = [] if doubts else sure_places(problem, first), before if doubts else first
    if not doubts and not options.unsure:
        sure, result = _sure_fit(problem, measured, sure)
    numbers = () if doubts else _numbers(problem, first, result, sure, records)
    chosen = [number for number in numbers if number.is_sure or options.unsure]
    written = records.write(chosen) if write else ()
    joints, held_out = (
        tuple(
            msgspec.structs.replace(joint, is_doubtful=bool(doubts))
            for joint in _joints(measured, each, before, result)
        )
        for each in (measured.evidence, measured.held_out)
    )
    unexcited = dict[str, list[str]]()
    for place in fitted:
        if not first.is_fitted[place] and place < problem.count:
            element, path = _name(problem, place)
            unexcited.setdefault(element, []).append(path)
    return Identification(
        robot=robot.name,
        log=shown(log),
        seconds=measured.seconds,
        rate=measured.rate,
        cutoff=measured.cutoff,
        delay=float(result.after[-1]),
        joints=joints,
        numbers=numbers,
        unexcited=tuple(Unexcited(element, tuple(paths)) for element, paths in unexcited.items()),
        freed=tuple(result.freed),
        dropped=measured.told(),
        held_out=held_out,
        written=written,
        is_doubtful=bool(doubts),
        diagnostics=(*(doubts or found), *notes, *measured.doubts(options), *records.notes),
        series=measured.series(signals.target_at(float(result.after[-1])), result.delta),
    )


def _of_log(problem: LeastSquares) -> range:
    """Return the places of the numbers that belong to a log, and to no record: offsets and the delay."""
    return range(problem.count, len(problem.start))


def _joints(measured: Measured, evidence: Evidence, before: Fit, after: Fit) -> tuple[JointFit, ...]:
    """Return how well the model explains each joint, with the offsets and the delay that suit it, before and after."""
    one, other = (
        measured.joint_fits(evidence, signals.target_at(float(each.after[-1])), each.delta) for each in (before, after)
    )
    return tuple(msgspec.structs.replace(b, before=a.after) for a, b in zip(one, other, strict=True))


def _doubts(joints: Sequence[JointFit]) -> Iterator[Diagnostic]:
    """Yield an error for each joint whose effort is hardly that of the robot."""
    most = {unit: max(joint.measured for joint in joints if joint.unit == unit) for unit in {j.unit for j in joints}}
    for joint in joints:
        if joint.after > _DOUBTFUL * joint.measured:
            words = f"no numbers explain its effort, {100 * joint.after / joint.measured:.0f} % is left"
        elif joint.after > joint.before + _CONSIDERABLE * joint.measured:
            words = "the fit is worse than no fit, since the efforts of the joints contradict each other"
        elif joint.before > joint.measured > _CONSIDERABLE * most[joint.unit]:
            share = 100 * joint.before / joint.measured
            words = f"the source's numbers are worse than none, {share:.0f} % of its effort is left before the fit"
        else:
            continue
        yield Diagnostic(Severity.ERROR, "identify", f"{joint.element}: {words}", hint=_HINT)


def _log_doubts(problem: LeastSquares, measured: Measured, delay: float) -> Iterator[Diagnostic]:
    """Yield an error for each joint whose effort is that of another unit, sign or joint, or of another motion.

    Yield a note for one whose effort may be that of another unit, as far as the log shows.
    """
    evidence, log = measured.evidence, measured.log
    friction = {loss.joint: loss.value for loss in problem.losses if loss.path.endswith("friction")}
    model = measured.at(np.array([*np.zeros(len(signals.SHIFTS)), 1.0]))
    gains = find_gains(problem, evidence, natural_sizes(problem, measured, evidence.roots(model)), delay)
    odd, least = gains.odd_axes(), gains.least_visible()
    efforts, left = (
        measured.unused.deviations(measured.parameters, measured.at(np.array([*signals.target_at(0.0)[:-1], part])))
        for part in (0.0, -1.0)
    )
    for j, axis in enumerate(measured.axes):
        column = log.columns[log.measured[j], "effort"]
        unit, cell = "N.m" if axis.unit == "rad" else "N", log.header[column.place]
        most = _STATED_GAIN if column.is_stated else _GAIN
        if j in odd:
            ratio = gains.factors[j] / abs(float(np.nanmedian(np.delete(gains.factors, j))))
            words = f"its effort in the log is {ratio:.3g} times the one that the efforts of the other joints tell"
            yield Diagnostic(Severity.ERROR, "identify", f"joint {axis.name}: {words}", hint=_HINT)
        elif evidence.counts[j] and not 1 / most < gains.usual < most:
            words = f"its effort in the log is {gains.usual:.3g} times that of a robot near the source"
            question = "" if column.is_stated else f"; if the log is right, state the unit: `{cell} [{unit}]`"
            yield Diagnostic(Severity.ERROR, "identify", f"joint {axis.name}: {words}", hint=_HINT + question)
        elif VISIBLE < least[j] < np.inf:
            when = f"show only from {math.ceil(10 * least[j]) / 10:g} on" if least[j] < _HUGE else "not show"
            words = f"in this log, a factor of its effort would {when}"
            yield Diagnostic(Severity.NOTE, "identify", f"joint {axis.name}: {words}", hint="check its unit")
        elif not evidence.counts[j] + measured.held_out.counts[j] and left[j] > max(
            _DOUBTFUL * efforts[j], _CONSIDERABLE * efforts.max(), 2 * friction.get(axis.name, 0.0)
        ):
            words = (
                f"it stands still or is at its limit, and {left[j]:.3g} {unit} of its effort are no effect of others"
            )
            yield Diagnostic(Severity.ERROR, "identify", f"joint {axis.name}: {words}", hint=_HINT)


def judge(config: Config, robot: RobotConfig, log: Path, options: IdentifyOptions, progress: Progress) -> Judgement:
    """Return how far the records of a robot are from a log. Raises UrdfsyncError."""
    records = read_records(config, robot, options.wait)
    regressor = records.regressor()
    measured = Measured(regressor, log, options, progress)
    problem, _, _ = _problem(regressor, measured, records, options)
    result = _fitted(problem, measured, _of_log(problem))
    joints = _joints(measured, measured.evidence, result, result)
    return Judgement(shown(log), measured.seconds, joints, tuple(measured.doubts(options)))


def _check_axes(regressor: Regressor) -> None:
    """Raise ConfigError for a robot without a joint that can be fitted."""
    if not regressor.axes:
        message = "the robot has no joint that can be fitted"
        hint = "a revolute, continuous or prismatic joint can; fixed, planar, floating and ball joints can't"
        raise ConfigError.of("identify", message, hint=hint)


def _check_names(options: IdentifyOptions, regressor: Regressor) -> None:
    """Raise ConfigError for a chosen link or joint that can't be fitted."""
    joints = list(dict.fromkeys(loss.joint for loss in regressor.losses))
    known = {"link": [body.name for body in regressor.bodies], "joint": joints}
    for kind, names in (("link", options.links), ("joint", options.joints)):
        for name in names:
            if name not in known[kind]:
                near = nearest(name, known[kind])
                hint = f"did you mean `{near}`?" if near else f"choose from {', '.join(known[kind])}"
                raise ConfigError.of("identify", f"`{name}` is no {kind} that moves and has numbers", hint=hint)


def _problem(
    regressor: Regressor, measured: Measured, records: Records, options: IdentifyOptions
) -> tuple[LeastSquares, list[int], list[Diagnostic]]:
    """Return the unknowns, the places of the numbers to fit, and what can't be fitted."""
    notes = list[Diagnostic]()
    chosen_links, chosen_joints = options.links, options.joints
    some = bool(chosen_links or chosen_joints)
    fitted, bodies = list[int](), list[MovingLink]()
    for k, body in enumerate(regressor.bodies):
        is_wanted = body.name in chosen_links if some else body.is_first
        if is_body(body):
            bodies.append(body)
            fitted += range(10 * k, 10 * k + 10) if is_wanted else ()
        else:
            bodies.append(body._replace(numbers=np.array([1.0, 0, 0, 0, 1, 1, 1, 0, 0, 0]), rotation=np.eye(3)))
            message = f"link {body.name}: no real body has its mass and inertia, so they are not fitted"
            notes += [Diagnostic(Severity.WARNING, "identify", message)] if is_wanted else []
    for k, loss in enumerate(regressor.losses, 10 * len(bodies)):
        is_stated = loss.path in records.values[f"joint {loss.joint}"]
        # the inertia of a drive that the source does not state can't be told from that of the link
        if (loss.joint in chosen_joints or not some) and (is_stated or not loss.path.endswith("armature")):
            fitted.append(k)
    fitted += range(measured.parameters, measured.parameters + len(measured.axes) + 1)
    return LeastSquares(bodies, regressor.losses, len(measured.axes)), fitted, notes


def natural_sizes(problem: LeastSquares, measured: Measured, efforts: Array | None = None) -> Array:
    """Return the natural size of each number: of losses, that with which they make up a whole effort.

    `efforts` are the root mean squares of the axes' efforts, else those in the log.
    """
    if efforts is None:
        efforts = measured.evidence.roots(measured.at(np.array([*signals.target_at(0.0)[:-1], 0.0])))
    usual = float(np.mean(efforts[measured.evidence.counts > 0]))
    efforts = np.where(measured.evidence.counts > 0, efforts, usual)
    by_joint = {
        axis.name: effort / measured.sizes[:, j]
        for j, (axis, effort) in enumerate(zip(measured.axes, efforts, strict=True))
    }
    unmeasured = np.full(3, usual)
    others = [max(loss.value, by_joint.get(loss.joint, unmeasured)[k % 3]) for k, loss in enumerate(problem.losses)]
    return problem.sizes(np.array([*others, *(_USUAL_OFFSET * efforts), _USUAL_DELAY]))


def _fitted(problem: LeastSquares, measured: Measured, fitted: Sequence[int]) -> Fit:
    sizes = natural_sizes(problem, measured)
    spread = problem.spread(sizes)
    first = fit(problem, measured.evidence, fitted, sizes, spread, np.ones(len(measured.axes)))
    series = measured.series(signals.target_at(first.after[-1]), first.delta)
    left = (series.measured - series.after).T
    alike = [
        signals.alike(each[used]) if used.any() else 1.0 for each, used in zip(left, series.is_used.T, strict=True)
    ]
    return fit(problem, measured.evidence, fitted, sizes, spread, np.array(alike))


def _sure_fit(problem: LeastSquares, measured: Measured, sure: Sequence[int]) -> tuple[list[int], Fit]:
    """Fit some numbers; return those whose change is still sure if the others stay, and the fit of these."""
    places = list(sure)
    while True:
        result = _fitted(problem, measured, [*places, *_of_log(problem)])
        fitted = [place for place in places if result.is_fitted[place]]
        changes = {place: abs(result.after[place] - problem.start[place]) for place in fitted}
        surenesses = {place: changes[place] / result.conditional_errors[place] for place in fitted}
        if not fitted or min(surenesses.values()) >= SURE:
            return places, result
        places.remove(min(fitted, key=surenesses.__getitem__))


def _name(problem: LeastSquares, place: int) -> tuple[str, str]:
    if place < (count := 10 * len(problem.bodies)):
        return f"link {problem.bodies[place // 10].name}", NUMBERS[place % 10]
    loss = problem.losses[place - count]
    return f"joint {loss.joint}", loss.path


def _numbers(
    problem: LeastSquares, first: Fit, last: Fit, sure: Collection[int], records: Records
) -> tuple[FittedNumber, ...]:
    """Return the numbers of a first fit; those whose change is sure are as the last fit has them."""
    numbers = list[FittedNumber]()
    for place in map(int, np.flatnonzero(first.is_fitted[: problem.count])):
        element, path = _name(problem, place)
        is_sure = place in sure and bool(last.is_fitted[place])
        result = last if is_sure else first
        number = FittedNumber(
            element=element,
            path=path,
            before=float(problem.start[place]),
            after=float(result.after[place]),
            error=float(result.errors[place]),
            conditional=float(result.conditional_errors[place]),
            is_sure=is_sure,
            is_written=records.has(element, path),
        )
        numbers.append(number)
    return tuple(numbers)


def find_motion(
    config: Config, robot: RobotConfig, seconds: float, seed: int, options: IdentifyOptions, progress: Progress
) -> tuple[str, Excitation]:
    """Return a motion that excites a robot's numbers, as a table for Run. Raises UrdfsyncError."""
    from urdfsync.analysis.identification.excite import excite

    regressor = read_records(config, robot, options.wait).regressor()
    _check_axes(regressor)
    _check_names(options, regressor)
    driven = [k for k, axis in enumerate(regressor.axes) if axis.input]
    if not driven:
        message = f"Run of robot `{robot.name}` has no input for a joint"
        raise ConfigError.of("identify", message, shown(robot.folder), hint='choose `inputs = "names"`')
    trajectory, efforts, first, condition, numbers = excite(regressor, seconds, seed, progress)
    tables = dict(zip(QUANTITIES, (trajectory.q, trajectory.v, efforts), strict=True))
    columns = [trajectory.times, *(tables[regressor.axes[k].command][:, k] for k in driven)]
    rows = [",".join(f"{number:.9g}" for number in row) for row in np.column_stack(columns)]
    header = ",".join(["time", *(regressor.axes[k].input for k in driven)])
    resting = tuple(axis.name for axis in regressor.axes if not axis.command)
    duration = float(trajectory.times[-1])
    return "\n".join([header, *rows, ""]), Excitation(robot.name, duration, first, condition, numbers, resting, {})
