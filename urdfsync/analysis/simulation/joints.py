"""Finds joints in a simulated model, their motion, and the limits that they passed."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, TypeAlias

from urdfsync.analysis.simulation.results import JointResult, LoopResult, PassedLimit, Range, Series
from urdfsync.domain.bench import Bench, JointSignals, Signal

_ENDLESS = 1e300
"""A larger limit is no limit: compilers write infinity as their greatest number."""
_ROUNDING = 1e-6
"""The margin of `UrdfSync.Functions.isAtMost`: this number in the quantity's unit, plus this fraction of the limit."""
_INTEGRATION = 1e-4
"""Up to this share of a quantity's whole range, an excess is an error of the integration and passes no limit.

With the tolerance of Test, 1e-6, a prescribed motion over 1 rad begins up to 2e-5 rad below 0. This does not count as
passing the lower limit 0.
"""


Layouts: TypeAlias = Sequence[Sequence[JointSignals]]
"""See `Bench.layouts`."""


def pattern(bench: Bench) -> str:
    """Return a regular expression for the variables of a robot's joints and loops, anywhere in a model."""
    axes = [axis for layout in bench.layouts for axis in layout]
    names = dict.fromkeys(name for axis in axes for _, signal in _signals(axis) for name in _names(signal))
    names |= dict.fromkeys(name for loop in bench.loops for name in (loop.gap, *loop.force, *loop.torque))
    return rf"(?:.*\.)?(?:{'|'.join(map(re.escape, names))})" if names else ""


def joint_results(layouts: Layouts, series: Series, parameters: Mapping[str, float]) -> list[JointResult]:
    """Return the result of each joint of each robot in a model, in the order of its layout."""
    results = []
    for place, layout in robots(layouts, series):
        for axis in layout:
            quantities, passed = dict[str, Range](), list[PassedLimit]()
            for name, signal in _signals(axis):
                values = _values(signal, place, series, parameters)
                if signal is axis.acceleration and values is not None:
                    values = _by_direction(values, _values(axis.velocity, place, series, parameters))
                if values is not None:
                    quantities[name] = _quantity(signal, place, values, parameters, signal is axis.acceleration)
                    passed += _passed(name, quantities[name], series["time"], values)
            if quantities:
                limits, follows = tuple(passed), axis.is_dependent
                results.append(JointResult(axis.element, place, **quantities, passed=limits, is_dependent=follows))
    return results


def energies(layouts: Layouts, series: Series, parameters: Mapping[str, float]) -> list[float | None]:
    """Return for each of `joint_results` the energy in J that its drive gives and takes; None without a drive."""
    import numpy as np  # see below

    amounts: list[float | None] = []
    for place, layout in robots(layouts, series):
        for axis in layout:
            given = {name: _values(signal, place, series, parameters) for name, signal in _signals(axis)}
            effort, speed = given.get("effort"), given.get("speed")
            if any(values is not None for values in given.values()):
                if effort is None or speed is None:
                    amounts.append(None)
                    continue
                power = np.abs(effort * speed)
                amounts.append(float((np.diff(series["time"]) * (power[:-1] + power[1:]) / 2).sum()))
    return amounts


def loop_results(bench: Bench, series: Series) -> Iterator[LoopResult]:
    """Yield the result of each loop of each robot in a model, except loops whose joint the user has replaced."""
    for place, _ in robots(bench.layouts, series) if bench.loops else ():
        for loop in bench.loops:
            vectors = [[_below(place, name) for name in names] for names in ((loop.gap,), loop.force, loop.torque)]
            if all(name in series for vector in vectors for name in vector):
                sizes = (max(map(math.hypot, *(series[name] for name in vector))) for vector in vectors)
                yield LoopResult(loop.element, place, *sizes)


def robots(layouts: Layouts, series: Series) -> list[tuple[str, Sequence[JointSignals]]]:
    """Return the components that are robots, with their layouts: no other component has a larger part of a layout.

    A robot need not have all positions of its layout, since the user may have replaced a joint by another model. Other
    components may have some positions, if they share the name of a joint.
    """
    shares: dict[tuple[str, int], float] = {}
    for number, layout in enumerate(layouts):
        for axis in layout:
            for name in series:
                if name == axis.position.variable or name.endswith(f".{axis.position.variable}"):
                    place = name.removesuffix(axis.position.variable).removesuffix(".")
                    # a body of the standard library has angles `phi[1]`, as the generic robot has, but no speeds
                    count = 1 + (_below(place, axis.velocity.variable) in series)
                    shares[place, number] = shares.get((place, number), 0.0) + count / len(layout)
    most = max(shares.values(), default=0.0)
    return [(place, layouts[number]) for (place, number), share in sorted(shares.items()) if math.isclose(share, most)]


def _signals(axis: JointSignals) -> Iterator[tuple[str, Signal]]:
    signals = {"position": axis.position, "speed": axis.velocity, "effort": axis.effort}
    yield from ((name, signal) for name, signal in (*signals.items(), ("acceleration", axis.acceleration)) if signal)


def _names(signal: Signal) -> Iterator[str]:
    yield from (signal.variable, *signal.limits, *(name for pair in signal.added for name in pair))


def _values(signal: Signal, place: str, series: Series, parameters: Mapping[str, float]) -> Any:
    """Return the numbers of a signal as an array; None if the model lacks the signal."""
    name = _below(place, signal.variable)
    if name not in series:
        return None
    import numpy as np  # takes 100 ms, which other commands save

    values = np.array(series[name])
    for factor, variable in ((_below(place, a), _below(place, b)) for a, b in signal.added):
        if factor in parameters and variable in series:
            values += parameters[factor] * np.array(series[variable])
    return values


def _by_direction(accelerations: Any, speeds: Any) -> Any:
    """Return the magnitudes of accelerations, negative where the joint slows down."""
    import numpy as np  # see above

    sizes = np.abs(accelerations)
    return sizes if speeds is None else np.where(accelerations * speeds < 0, -sizes, sizes)


def _quantity(signal: Signal, place: str, values: Any, parameters: Mapping[str, float], is_acceleration: bool) -> Range:
    limits = [parameters.get(_below(place, limit), math.inf) for limit in signal.limits] or [math.inf]
    if len(limits) == 1 or is_acceleration:
        limits = [-limits[0], limits[-1]]
    lower, upper = (limit if abs(limit) < _ENDLESS else None for limit in limits)
    name = _below(place, signal.variable)
    return Range(name, signal.unit, float(values.min()), float(values.max()), lower, upper)


def _passed(name: str, quantity: Range, times: Sequence[float], values: Any) -> Iterator[PassedLimit]:
    """Yield the limits that a quantity passes by more than rounding and errors of the integration."""
    import numpy as np  # see above

    for limit, sign in ((quantity.lower, -1), (quantity.upper, 1)):
        if limit is not None:
            excess = sign * (values - limit)
            rounding = _ROUNDING * (1 + abs(limit))
            is_beyond = excess > rounding + _INTEGRATION * (quantity.greatest - quantity.least)
            if is_beyond.any():
                seconds = float(np.diff(times)[is_beyond[:-1]].sum())
                first = float(times[int(is_beyond.argmax())])
                yield PassedLimit(name, limit, first, float(excess.max()), seconds)


def _below(place: str, name: str) -> str:
    return f"{place}.{name}" if place else name
