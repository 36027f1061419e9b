"""Reads a log of positions, velocities and efforts of joints piece by piece: CSV, Parquet, recordings of ROS 2.

A piece has at most 50,000 rows, however long the file is. Gaps and resets of the time end a piece.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from urdfsync.analysis.identification.process import LogProcess, is_recording
from urdfsync.analysis.identification.results import IdentifyOptions
from urdfsync.analysis.identification.tables import TIME_UNITS, refuse
from urdfsync.analysis.simulation.motion import UNITS
from urdfsync.common.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.common.files import kind_of, shown
from urdfsync.common.spelling import counted, name_and_unit
from urdfsync.domain.regressor import QUANTITIES, Array, Axis

_LEAST = 50
"""Shorter pieces are left out: the filter takes as much from both ends."""
_GAP = 5
"""A step in time of so many usual steps is a gap."""
_SEPARATORS = re.compile(r"[\W_]+")
_WORDS = {
    "position": "position positions pos q phi s",
    "velocity": "velocity velocities vel speed qd dq w v",
    "effort": "effort efforts eff torque force tau f current",
}
_ALL_WORDS = {word for words in _WORDS.values() for word in words.split()}
_PREFIX = re.compile(r"^[\W_]*(joint[\W_]*states[\W_]*)?(robot[\W_]*)?", re.IGNORECASE)
_TIMES = ("time", "t", "timestamp", "stamp")
_UNSORTED = 0.1
"""A greater share of steps back in time is no reset."""
_SLOWEST = 0.2
"""A greater usual step in s is no log of a motion, but another unit."""
_UNITS = {
    ("rad", "position"): "rad",
    ("rad", "velocity"): "rad/s",
    ("rad", "effort"): "N.m",
    ("m", "position"): "m",
    ("m", "velocity"): "m/s",
    ("m", "effort"): "N",
}
_MARGIN = 1.05
"""So far beyond its limits, as a factor, a joint is in another unit."""
_FAR = 3.0
"""Beyond its limits, as a factor, a joint is in an unknown unit; below, the log passes a limit of the source."""
_GREATEST = 1e9
"""In SI: greater numbers are faults of a recorder."""
_SURE_MOTION = 0.05
"""In rad or m · 10: positions that deviate less do not judge recorded velocities."""
_VARIABLES = {
    "rad": {"position": "robot.{}.revolute.phi", "velocity": "robot.{}.revolute.w", "effort": "robot.{}Axis.tau"},
    "m": {"position": "robot.{}.prismatic.s", "velocity": "robot.{}.prismatic.v", "effort": "robot.{}Axis.f"},
}
"""Names in a table of `simulate --csv`, in which all numbers are in SI."""


class Column(NamedTuple):
    """A column of the log."""

    place: int
    factor: float
    is_stated: bool
    """Whether the header, the user or `simulate` has stated the unit: then it is not guessed."""


class LogPiece(NamedTuple):
    """Samples without a gap: times in s, and a column for each axis in SI at the joint's side."""

    times: Array
    position: Array
    velocity: Array | None
    effort: Array


class Log:
    """A log, read once; `dropped` tells after that what was left out."""

    def __init__(self, file: Path, axes: Sequence[Axis], options: IdentifyOptions) -> None:
        """Raises UrdfsyncError for a file without positions and efforts of a joint."""
        self.file, self._axes, self._options = file, axes, options
        self.dropped = Counter[str]()
        self.ranges = dict[int, tuple[float, float]]()
        """The least and the greatest position of each measured axis."""
        is_bag = is_recording(file)
        if not file.exists() or not (is_bag or file.is_file()):
            what = f"{kind_of(file.stat().st_mode)} is there" if file.exists() else "there is no such file"
            refuse(file, what, hint="name a CSV or Parquet file, or a recording of ROS 2")
        if options.topic and not is_bag:
            raise ConfigError.of("log", "`--topic` is for recordings of ROS 2", shown(file))
        self._content = LogProcess(file, options.topic)
        self.header, instants = self._content.open()
        self.time, self.columns = self._find_columns()
        if self.time.place in instants:  # they have their unit, whatever the header says
            self.time = self.time._replace(factor=1.0)
        self.measured = [k for k in range(len(axes)) if {(k, "position"), (k, "effort")} <= self.columns.keys()]
        """The axes with positions and efforts, by number."""
        used = {self.time.place, *(column.place for column in self.columns.values())}
        self.unused = [name for place, name in enumerate(self.header) if place not in used]
        if not self.measured:
            names = ", ".join(axis.name for axis in axes)
            message = f"no joint has a position and an effort: the columns are {', '.join(self.header)[:300]}"
            first = axes[0].name
            hint = f"the joints are {names}: name the columns {first}.position and {first}.effort, or give "
            refuse(file, message, 1, hint + f"`--column {first}.effort=NAME`")

    def _find_columns(self) -> tuple[Column, dict[tuple[int, str], Column]]:
        levels, time = _aliases(self._axes), None
        simulated = {
            name.format(axis.component): (k, quantity)
            for k, axis in enumerate(self._axes)
            for quantity, name in _VARIABLES[axis.unit].items()
        }
        is_simulated = not simulated.keys().isdisjoint(self.header)
        stated = dict(self._stated())
        taken = {column.place for column in stated.values()}
        columns = dict[tuple[int, str], Column]()
        for place, cell in enumerate(self.header):
            if place in taken:
                continue
            name, unit = name_and_unit(cell)
            if _plain(_bare(name)) in _TIMES and time is None:
                time = Column(place, TIME_UNITS.get(unit) or self._factor(cell, unit, "s"), is_stated=bool(unit))
                continue
            meant = [each for each in _meant(name, levels) if each not in stated]
            if len(meant) > 1:
                of = " or ".join(f"the {quantity} of {self._axes[k].name}" for k, quantity in meant)
                k, quantity = meant[0]
                hint = f"choose by `--column {self._axes[k].name}.{quantity}={cell}`"
                refuse(self.file, f"column `{cell}` may be {of}", 1, hint)
            for k, quantity in meant:
                factor = self._factor(cell, unit, _UNITS[self._axes[k].unit, quantity])
                if (k, quantity) in columns:
                    both = f"`{self.header[columns[k, quantity].place]}` and `{cell}`"
                    message = f"two columns give the {quantity} of {self._axes[k].name}: {both}"
                    hint = f"rename one, or choose by `--column {self._axes[k].name}.{quantity}={cell}`"
                    refuse(self.file, message, 1, hint)
                columns[k, quantity] = Column(place, factor, is_stated=bool(unit) or is_simulated)
        columns |= stated
        for place, cell in enumerate(self.header):
            if cell in simulated:  # the inputs and outputs of Run have the same numbers
                columns.setdefault(simulated[cell], Column(place, 1.0, is_stated=True))
        if time is None:
            refuse(self.file, "no column is the time", 1, "name it `time` in s, or `time [ms]`")
        if self._options.motor_side:
            if columns and all(self._axes[k].reduction == 1 for k, _ in columns):
                message = "`--motor-side` needs gears, and the source has none for the joints of the log"
                raise ConfigError.of("log", message, shown(self.file), hint="give factors with `--column`")
            for (k, quantity), column in columns.items():
                ratio = self._axes[k].reduction
                factor = column.factor * (ratio if quantity == "effort" else 1 / ratio)
                columns[k, quantity] = Column(column.place, factor, is_stated=column.is_stated or ratio != 1)
        return time, columns

    def _stated(self) -> Iterator[tuple[tuple[int, str], Column]]:
        """Yield the columns that the user names: `elbow.effort=current3*21.5`. Raises ConfigError."""
        joints = {axis.name: k for k, axis in enumerate(self._axes)}
        for text in self._options.columns:
            target, _, source = text.partition("=")
            joint, _, quantity = target.rpartition(".")
            name, star, number = source.rpartition("*")
            name, factor = (name, number) if star and source not in self.header else (source, "")
            if joint not in joints or quantity not in QUANTITIES or name not in self.header:
                names = f"the joints are {', '.join(joints)}; the columns are {', '.join(self.header)[:300]}"
                message = f"`--column {text}` names no joint, quantity ({', '.join(QUANTITIES)}) or column"
                raise ConfigError.of("log", message, hint=names)
            k, unit = joints[joint], name_and_unit(name)[1]
            try:
                value = float(factor) if factor else self._factor(name, unit, _UNITS[self._axes[k].unit, quantity])
            except ValueError:
                raise ConfigError.of("log", f"`--column {text}`: {factor!r} is no number") from None
            if not value or not math.isfinite(value):
                raise ConfigError.of("log", f"`--column {text}`: the factor has to be finite, and not 0")
            yield (k, quantity), Column(self.header.index(name), value, is_stated=bool(factor or unit))

    def _factor(self, cell: str, unit: str, wanted: str) -> float:
        if unit and unit not in UNITS[wanted]:
            refuse(self.file, f"`{cell}` can't be read in {unit}", 1, f"give it in {' or '.join(UNITS[wanted])}")
        return UNITS[wanted][unit] if unit else 1.0

    def pieces(self) -> Iterator[LogPiece]:
        """Yield the pieces of the log. Raises SourceError for a row that can't be read, and for wrong units."""
        usual, last = 0.0, -math.inf
        for rows in self._content.rows():
            used = [self.time.place, *(column.place for column in self.columns.values())]
            whole = np.isfinite(rows[:, used]).all(axis=1)
            self.dropped["row without a number"] += int(np.count_nonzero(~whole))
            rows = rows[whole]
            times = self.time.factor * rows[:, self.time.place]
            steps = np.diff(times, prepend=last)
            if np.count_nonzero(steps[1:] < 0) > _UNSORTED * len(steps):
                count = np.count_nonzero(steps[1:] < 0)
                message = f"times are not sorted: {count} of {len(steps)} rows are earlier than the row before"
                refuse(self.file, message, hint="sort the rows by time")
            usual = usual or (float(np.median(steps[1:][steps[1:] > 0])) if (steps[1:] > 0).any() else 0.0)
            self._check_steps(usual)
            again = steps == 0
            self.dropped["row with the time of the row before"] += int(np.count_nonzero(again))
            rows, times, steps = rows[~again], times[~again], steps[~again]
            breaks = (steps < 0) | (steps > _GAP * usual)
            self.dropped["reset of the time"] += int(np.count_nonzero(steps < 0))
            self.dropped["gap"] += int(np.count_nonzero(np.isfinite(steps) & (steps > _GAP * usual)))
            last = times[-1] if len(times) else last
            for part in np.split(np.arange(len(times)), np.flatnonzero(breaks)):
                if len(part) >= _LEAST:
                    yield self._piece(times[part], rows[part])
                elif len(part):
                    self.dropped["row in a piece that is too short"] += len(part)

    def _piece(self, times: Array, rows: Array) -> LogPiece:
        shape = len(rows), len(self._axes)
        tables = {quantity: np.zeros(shape) for quantity in QUANTITIES}
        tables["position"] += [axis.start for axis in self._axes]
        for k, quantity in self.columns:
            tables[quantity][:, k] = self._in_si(times, rows, k, quantity)
        for k in self.measured:
            self._check_position(k, tables["position"][:, k])
        for k, quantity in self.columns:
            if quantity == "velocity" and (k, "position") in self.columns:
                self._check_velocity(self._axes[k], times, tables["position"][:, k], tables["velocity"][:, k])
        moving = [k for k in range(shape[1]) if (k, "position") in self.columns]
        has_velocities = all((k, "velocity") in self.columns for k in moving)
        return LogPiece(times, tables["position"], tables["velocity"] if has_velocities else None, tables["effort"])

    def _check_steps(self, usual: float) -> None:
        """Refuse times in another unit than the header says."""
        if usual > _SLOWEST:
            units = [unit for unit in ("ms", "us", "ns") if usual * TIME_UNITS[unit] <= _SLOWEST]
            hint = f"write `time [{units[0]}]` if that is its unit" if units else ""
            refuse(self.file, f"the log has a row each {usual:.4g} s, too few for a motion", 1, hint)

    def _in_si(self, times: Array, rows: Array, k: int, quantity: str) -> Array:
        """Return the numbers of a column. Raises SourceError for one that nobody has measured."""
        column = self.columns[k, quantity]
        with np.errstate(over="ignore"):
            values = column.factor * rows[:, column.place]
        if (faults := np.flatnonzero(~(np.abs(values) < _GREATEST))).size:
            number, time = rows[faults[0], column.place], times[faults[0]]
            message = f"`{self.header[column.place]}` is {number:g} at {time:.9g} s, which nobody has measured"
            refuse(self.file, message, hint="leave the row out, or state the unit")
        return np.asarray(values)

    def _check_position(self, k: int, values: Array) -> None:
        """Refuse positions far beyond the limits of a joint, unless their unit is stated."""
        axis, low, high = self._axes[k], float(values.min()), float(values.max())
        before = self.ranges.get(k, (low, high))
        self.ranges[k] = min(low, before[0]), max(high, before[1])
        is_limited = np.isfinite(axis.range).all()
        width, most = max(map(abs, axis.range)) if is_limited else 40 * math.pi, max(-low, high)
        column = self.columns[k, "position"]
        if column.is_stated or most <= (_FAR if is_limited else _MARGIN) * width:
            return
        cell = name_and_unit(self.header[column.place])[0]
        message = f"{axis.name} moves from {low:.4g} to {high:.4g} {axis.unit}, far beyond its limits"
        other, unit, factor = ("degrees", "deg", math.pi / 180) if axis.unit == "rad" else ("millimetres", "mm", 1e-3)
        hint = f"state the unit in the header: `{cell} [{unit}]` or `{cell} [{axis.unit}]`"
        if abs(axis.reduction) > 1 and most / abs(axis.reduction) <= _MARGIN * width:
            hint = f"give `--motor-side`, or {hint}"
            refuse(self.file, f"{message}: its motor would, by a gear of {axis.reduction:g}", 1, hint)
        words = f": these look like {other}" if factor * most <= _MARGIN * width else ""
        refuse(self.file, f"{message}{words}", 1, hint)

    def _check_velocity(self, axis: Axis, times: Array, position: Array, velocity: Array) -> None:
        """Refuse velocities that are not those of the positions: other units, signs or joints."""
        way = np.concatenate([[0.0], np.cumsum(np.diff(times) * (velocity[1:] + velocity[:-1]) / 2)])
        line = np.column_stack([np.ones_like(times), times - times[0]])  # an offset of the sensor drifts
        position, way = (each - line @ np.linalg.lstsq(line, each, rcond=None)[0] for each in (position, way))
        ratio = float(position @ way / max(position @ position, 1e-300))
        if np.std(position) > (_SURE_MOTION if axis.unit == "rad" else _SURE_MOTION / 10) and not 0.5 < ratio < 2:
            message = f"the velocity of {axis.name} is {ratio:.3g} times that of its position"
            refuse(self.file, message, 1, "state units in the header, or leave out the column of the velocity")

    def doubts(self) -> Iterator[Diagnostic]:
        """Yield a warning for each joint that passes a limit of its position."""
        for k, (low, high) in self.ranges.items():
            axis = self._axes[k]
            first, last = axis.range
            if max(first - low, high - last) > (_MARGIN - 1) / 5 * (last - first):
                message = f"joint {axis.name}: position passes its limits, {first:.4g} … {last:.4g} {axis.unit}"
                hint = f"the log has {low:.4g} … {high:.4g}: correct the limits, or the unit in the header of the log"
                yield Diagnostic(Severity.WARNING, "limit-passed", message, shown(self.file), hint=hint)

    def told(self) -> tuple[str, ...]:
        """Return what was left out, in words."""
        parts = [(number, *what.partition(" ")) for what, number in self.dropped.items() if number]
        rows = tuple(f"{counted(number, noun)}{space}{rest}" for number, noun, space, rest in parts)
        others = [axis.name for k, axis in enumerate(self._axes) if (k, "position") not in self.columns]
        resting = (f"not in the log, taken to rest at the start: {', '.join(others)}",) if others else ()
        unused = (f"columns without a use: {', '.join(self.unused)[:300]}",) if self.unused else ()
        return (*rows, *resting, *unused)


def _aliases(axes: Sequence[Axis]) -> list[dict[str, list[tuple[int, str]]]]:
    """Return what columns mean by their names: first of names as they are, then of those with other separators."""
    levels: list[dict[str, list[tuple[int, str]]]] = [{} for _ in range(4)]
    for k, axis in enumerate(axes):
        for quantity, words in _WORDS.items():
            for word in words.split():
                for which, name in enumerate(dict.fromkeys([axis.name, axis.component])):
                    for text in (f"{name}/{word}", f"{word}/{name}"):
                        for level, key in ((which, _evened(text)), (2, _spelled(text)), (3, _plain(text))):
                            meant = levels[level].setdefault(key, [])
                            if (k, quantity) not in meant:
                                meant.append((k, quantity))
    return levels


def _meant(name: str, levels: Sequence[dict[str, list[tuple[int, str]]]]) -> list[tuple[int, str]]:
    for text in dict.fromkeys([name, _bare(name)]):
        for key, level in zip((_evened(text), _evened(text), _spelled(text), _plain(text)), levels, strict=True):
            if key in level:
                return level[key]
    return []


def _evened(text: str) -> str:
    """Return a name with one separator at its ends, where the quantity stands, and the joint as it is."""
    text = text.strip("/ ")
    if not (found := [*_SEPARATORS.finditer(text)]):
        return text
    first, last = found[0], found[-1]
    head, tail = text[: first.start()].lower(), text[last.end() :].lower()
    if tail in _ALL_WORDS:
        return f"{text[: last.start()]}/{tail}"
    return f"{head}/{text[first.end() :]}" if head in _ALL_WORDS else text


def _spelled(text: str) -> str:
    return _SEPARATORS.sub("_", text).strip("_").lower()


def _bare(name: str) -> str:
    """Return a name without what recorders put before it."""
    return _PREFIX.sub("", name)


def _plain(name: str) -> str:
    return _SEPARATORS.sub("", name).lower()
