"""Reads a motion from a CSV file with the inputs of a model, and writes it as Modelica.

Positions and speeds follow a cubic spline, which can be differentiated; other inputs follow straight lines. For rumoca,
a model with `CombiTimeTable`, or a function without a known derivative, is structurally singular.
"""

from __future__ import annotations

import bisect
import csv
import functools
import io
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NoReturn

import msgspec

from urdfsync.analysis.simulation.models import Input
from urdfsync.common.dependencies.facts import read_unrecorded
from urdfsync.common.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.common.files import shown
from urdfsync.common.numerals import MarkError, Row, find_separator, with_points
from urdfsync.common.spelling import name_and_unit, nearest

MOST_ROWS = 10_000

UNITS = {
    "rad": {"rad": 1.0, "deg": math.pi / 180},
    "m": {"m": 1.0, "mm": 1e-3},
    "rad/s": {"rad/s": 1.0, "deg/s": math.pi / 180},
    "m/s": {"m/s": 1.0, "mm/s": 1e-3},
    "N.m": {"N.m": 1.0, "N·m": 1.0, "Nm": 1.0, "N.mm": 1e-3, "kN.m": 1e3},
    "N": {"N": 1.0, "kN": 1e3},
    "s": {"s": 1.0, "ms": 1e-3},
}
"""The possible units of a column, with their factors, by the unit of the input."""
_SMOOTH = ("rad", "m", "rad/s", "m/s")
_NO_MOTION = "write a header, `time` and the inputs, and two rows or more"
_STEEPEST = 1e100
"""The greatest change of an input, also over the square of the time in s; a spline through steeper rows has no finite
numbers."""
_OVERSHOOT = 0.05
"""The share of the range of an input by which its spline may leave two rows; a sine with 8 rows a turn takes 0.04."""
_STRAIGHT = 2
"""Up to this number of rows, the spline is a straight line."""


class InputMotion(msgspec.Struct, frozen=True):
    """Times in s, from 0 on, and the value of each input at each time, in the unit of the input."""

    times: tuple[float, ...]
    values: tuple[tuple[Input, tuple[float, ...]], ...]


def read_motion(file: Path, inputs: Sequence[Input]) -> InputMotion:
    """Read a CSV file with a first column `time`, and a column for each input. Raises SourceError."""
    if not inputs:
        _refuse(file, "the model has no inputs that a motion could drive", hint="leave `--input` out")
    (line, header), *rows = read_rows(file, "motion", MOST_ROWS, "rows", _NO_MOTION, least=2)
    factors = _columns(file, line, header, inputs)
    columns: dict[str, list[float]] = {name: [] for name in factors}
    for line, row in rows:
        if len(row) != len(header):
            _refuse(file, f"the row has {len(row)} cells, the header {len(header)}", line)
        for cell, (name, factor) in zip(row, factors.items(), strict=True):
            columns[name].append(factor * _number(file, line, cell))
        before, time = columns["time"][-2:] if len(columns["time"]) > 1 else (-math.inf, columns["time"][-1])
        if time <= before:
            hint = "sort the rows by time"
            _refuse(file, f"the time does not increase: {before:g} s, then {time:g} s", line, hint)
        for name, numbers in columns.items():
            change = numbers[-1] - numbers[-2] if len(numbers) > 1 else 0.0
            if not abs(change) < _STEEPEST * min(1.0, time - before) ** 2:
                hint = "give smaller numbers, or rows that are farther apart"
                _refuse(
                    file, f"`{name}` changes by {change:g} within {time - before:g} s, which is too fast", line, hint
                )
    if (start := columns["time"][0]) != 0:
        _refuse(file, f"the time begins at {start:g} s", rows[0][0], "begin the time at 0")
    return InputMotion(tuple(columns["time"]), tuple((signal, tuple(columns[signal.name])) for signal in inputs))


def read_rows(file: Path, code: str, most: int, noun: str, missing: str, *, least: int = 1) -> Sequence[Row]:
    """Return the rows of a CSV file that are not empty, with their line numbers. Raises SourceError with this code.

    The file has a header, and from `least` to `most` rows below it; `missing` is the hint for a file with fewer.
    """
    refuse = functools.partial(_refuse, file, code=code)
    try:
        text = read_unrecorded(file).decode("utf-8-sig")  # does not wait for a pipe, or read an endless device
    except OSError as error:
        refuse(f"the file can't be read: {error.strerror}", hint="name a CSV file")
    except UnicodeDecodeError as error:
        line = error.object.count(b"\n", 0, error.start) + 1
        refuse("the file is not in UTF-8", line, "save it as UTF-8")
    (separator, text), rows = find_separator(text), list[Row]()
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    try:
        for row in reader:
            if any(cell.strip() for cell in row):
                rows.append((reader.line_num, row))
            if len(rows) > most + 1:
                refuse(f"the file has more than {most} {noun}", hint="leave some out")
    except csv.Error as error:
        refuse(f"the file is no CSV: {error}", reader.line_num)
    if len(rows) < 1 + least:
        refuse(f"the file has no {noun}" if least == 1 else "the file has no motion", hint=missing)
    try:
        return rows if separator == "," else [rows[0], *with_points(rows[1:], range(len(rows[0][1])))]
    except MarkError as error:
        refuse(error.message, error.line, error.hint)


def at_rest(inputs: Sequence[Input], stop: float) -> InputMotion:
    """Return a motion with all inputs at 0 until `stop`."""
    return InputMotion((0.0, stop), tuple((signal, (0.0, 0.0)) for signal in inputs))


def find_overshoots(motion: InputMotion, file: Path) -> Iterator[Diagnostic]:
    """Yield a warning for each input whose spline leaves the values of its rows by more than rows of a sine would."""
    from scipy.interpolate import CubicSpline  # see `second_derivatives`

    for signal, values in motion.values if len(motion.times) > _STRAIGHT else ():
        if signal.unit not in _SMOOTH:
            continue
        curve, size = CubicSpline(motion.times, values), max(values) - min(values)
        turns = [float(time) for time in curve.derivative().roots(extrapolate=False) if math.isfinite(time)]
        worst, at, row = 0.0, 0.0, 0
        for time in turns:
            after = min(max(bisect.bisect(motion.times, time), 1), len(values) - 1)
            low, high = sorted(values[after - 1 : after + 1])
            excess = max(float(curve(time)) - high, low - float(curve(time)))
            worst, at, row = max((worst, at, row), (excess, time, after))
        if worst > _OVERSHOOT * size:
            unit = f"{signal.unit} ({math.degrees(curve(at)):.4g}°)" if signal.unit == "rad" else signal.unit
            ends = " and ".join(f"{value:.4g}" for value in values[row - 1 : row + 1])
            message = f"`{signal.name}` reaches {curve(at):.4g} {unit} at {at:.4g} s, and the rows around have {ends}"
            hint = "add rows there, since a cubic spline joins the rows"
            yield Diagnostic(Severity.WARNING, "overshoot", message, shown(file), hint=hint)


def sampled(motion: InputMotion, times: Sequence[float]) -> dict[str, list[float]]:
    """Return the value of each input at other times, as the functions of `in_modelica` compute it."""
    from scipy.interpolate import CubicSpline, make_interp_spline

    samples = {}
    for signal, values in motion.values:
        curve = (
            CubicSpline(motion.times, values) if signal.unit in _SMOOTH else make_interp_spline(motion.times, values, 1)
        )
        samples[signal.name] = [float(value) for value in curve(times)]
    return samples


def _columns(file: Path, line: int, header: Sequence[str], inputs: Sequence[Input]) -> dict[str, float]:
    """Return the columns in their order, each with the factor of its unit."""
    factors: dict[str, float] = {}
    units = {"time": "s", **{signal.name: signal.unit for signal in inputs}}
    for cell in header:
        name, unit = name_and_unit(cell)
        if not unit or unit[0].isdigit():  # `q[1]` is an item of an input
            name, unit = cell.strip(), ""
        if not factors and name != "time":
            _refuse(file, f"the first column is `{name}`, not `time`", line, "name `time` first, then the inputs")
        if name not in units:
            near = nearest(name, units)
            others = f"the inputs are {', '.join(list(units)[1:])}"
            _refuse(file, f"the model has no input `{name}`", line, f"did you mean `{near}`?" if near else others)
        if name in factors:
            _refuse(file, f"the column `{name}` is there twice", line)
        possible = UNITS.get(units[name], {units[name]: 1.0})
        if unit and unit not in possible:
            hint = f"give it in {' or '.join(filter(None, possible))}"
            _refuse(file, f"`{name}` can't be given in {unit}", line, hint)
        factors[name] = possible[unit] if unit else 1.0
    if missing := [name for name in units if name not in factors]:
        _refuse(file, f"columns are missing: {', '.join(missing)}", line)
    return factors


def _number(file: Path, line: int, cell: str) -> float:
    try:
        number = float(cell)
    except ValueError:
        number = math.nan
    if not math.isfinite(number) or "_" in cell:
        _refuse(file, f"{cell.strip()!r} is no number", line)
    return number


def _refuse(file: Path, message: str, line: int = 0, hint: str = "", *, code: str = "motion") -> NoReturn:
    raise SourceError.of(code, message, shown(file), line, hint=hint)


_FUNCTION = """
  function {name}{number}
    input Real t;{inputs}
    output Real y;
  protected
    Integer k;
    Integer top;
    Integer middle;
    Real h;
    Real a;
    Real b;
  algorithm
    k := 1;
    top := {count};
    middle := 1;
    for i in 1:{halvings} loop
      middle := div(k + top, 2);
      if t >= times[middle] then
        k := middle;
      else
        top := middle;
      end if;
    end for;
    h := times[k + 1] - times[k];
    a := (times[k + 1] - t)/h;
    b := (t - times[k])/h;
    y := {value};{annotation}
  end {name}{number};
"""
_KINDS = (
    (
        "course",
        "",
        "a*q{0}[k] + b*q{0}[k + 1] + ((a^3 - a)*m{0}[k] + (b^3 - b)*m{0}[k + 1])*h^2/6",
        "(derivative = slope{0})",
    ),
    (
        "slope",
        "\n    input Real t1;",
        "t1*((q{0}[k + 1] - q{0}[k])/h + ((1 - 3*a^2)*m{0}[k] + (3*b^2 - 1)*m{0}[k + 1])*h/6)",
        "(derivative(order = 2) = bend{0})",
    ),
    ("bend", "\n    input Real t1;\n    input Real t2;", "a*m{0}[k] + b*m{0}[k + 1]", ""),
)
"""Value, first and second derivative of a spline through the points `times`, `q`, with second derivatives `m`."""


class ModelicaMotion(msgspec.Struct, frozen=True):
    """A motion in Modelica."""

    functions: str = ""
    """Functions of a package."""
    declarations: tuple[str, ...] = ()
    equations: tuple[str, ...] = ()
    """Equations of a model whose inputs follow the motion."""

    def held(self, motion: InputMotion, step: float) -> ModelicaMotion:
        """Return the motion for an FMU for co-simulation, whose inputs change only at each step."""
        declarations, whens, equations = [], [], []
        for number, (signal, values) in enumerate(motion.values, 1):
            declarations.append(f"discrete Real held{number}(start = {values[0]!r}, fixed = true);")
            whens.append(f"held{number} = course{number}(time);")
            equations.append(f"{signal.name} = held{number};")
        when = [f"when sample(0, {step!r}) then", *whens, "end when;"]
        return ModelicaMotion(self.functions, tuple(declarations), (*when, *equations))


def in_modelica(motion: InputMotion) -> ModelicaMotion:
    """Return functions of a package, and for each input an equation that calls its function."""
    count, lines, equations = len(motion.times), [_constant("times", motion.times)], []
    halvings = max(1, math.ceil(math.log2(count - 1)))
    for number, (signal, values) in enumerate(motion.values, 1):
        bends = second_derivatives(motion.times, values) if signal.unit in _SMOOTH else [0.0] * count
        lines += [_constant(f"q{number}", values), _constant(f"m{number}", bends)]
        for name, inputs, value, derivative in _KINDS:
            annotation = f"\n    annotation {derivative.format(number)};" if derivative else ""
            words = {"inputs": inputs, "value": value.format(number), "annotation": annotation}
            text = _FUNCTION.format(name=name, number=number, count=count, halvings=halvings, **words)
            lines.append(text)
        equations.append(f"{signal.name} = course{number}(time);")
    return ModelicaMotion("".join(lines), (), tuple(equations))


def _constant(name: str, values: Sequence[float]) -> str:
    return f"  constant Real {name}[{len(values)}] = {{{', '.join(map(repr, values))}}};\n"


def second_derivatives(times: Sequence[float], values: Sequence[float]) -> list[float]:
    """Return the second derivatives of a cubic spline through points.

    The spline's third derivative has no jump at the second point and at the last but one. So the spline is exact for a
    cubic. Through three points the spline is a parabola, through two points a straight line.
    """
    from scipy.interpolate import CubicSpline  # the import takes 0.5 s, which other simulations save

    return [float(number) for number in CubicSpline(times, values)(times, 2)]
