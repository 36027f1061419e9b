"""Draws positions, speeds and efforts of joints against their limits with matplotlib: a column for each six joints."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from typing import Any

from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from urdfsync.diagnostics import ConfigError
from urdfsync.simulation.results import JointResult, Range, SimulateResult

_ROWS = ("position", "speed", "effort")
_PER_COLUMN = 6
_MOST = 12
"""The greatest number of series of a picture without joints."""
_WIDTH, _HEIGHT = 6.4, 2.6
"""Width and height of a panel, in inches."""
_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""The colours of Okabe and Ito, which colour-blind people can distinguish."""


def draw(result: SimulateResult, kind: str) -> bytes:
    """Return a picture, `png` or `svg`; the same result gives the same bytes.

    Without joints, the picture has the other series. Raises ConfigError for too many series.
    """
    series = [] if result.joints else [name for name in result.series if name != "time"]
    if not (result.joints or 0 < len(series) <= _MOST):
        message = f"the simulation has no joints, and {len(series)} variables: a picture has at most {_MOST}"
        raise ConfigError.of("no-plot", message, hint="name some with `--variable`")
    # no dates in SVG; `$` in the name of a joint begins no formula
    plain = {"svg.hashsalt": "urdfsync", "text.parse_math": False, "text.usetex": False}
    with rc_context({**plain, "font.size": 9, "axes.grid": True, "grid.alpha": 0.3}):
        if series:
            return _saved(_draw_series(result, series), kind)
        columns = list(_columns(result.joints))
        figure = Figure(figsize=(_WIDTH * len(columns), _HEIGHT * len(_ROWS)), layout="constrained")
        FigureCanvasAgg(figure)
        panels: Any = figure.subplots(len(_ROWS), len(columns), sharex=True, squeeze=False)
        figure.suptitle(result.model)
        for column, joints in enumerate(columns):
            last = panels[0][column]
            for row, name in enumerate(_ROWS):
                if not any(getattr(joint, name) for joint in joints):
                    panels[row][column].set_visible(False)  # a joint that follows another has no effort
                    continue
                last = panels[row][column]
                _draw_panel(last, name, joints, result)
            last.set_xlabel("time [s]")
            last.tick_params(labelbottom=True)
            panels[0][column].legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
        return _saved(figure, kind)


def _draw_series(result: SimulateResult, names: Sequence[str]) -> Figure:
    figure = Figure(figsize=(2 * _WIDTH, 2 * _HEIGHT), layout="constrained")
    FigureCanvasAgg(figure)
    panel: Any = figure.subplots()
    figure.suptitle(result.model)
    for name in names:
        panel.plot(result.series["time"], result.series[name], label=name)
    panel.set_xlabel("time [s]")
    panel.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    return figure


def _saved(figure: Figure, kind: str) -> bytes:
    content = io.BytesIO()
    metadata = {"Date": None} if kind == "svg" else {"Software": None}
    figure.savefig(content, format=kind, dpi=120, metadata=metadata)
    return content.getvalue()


def _columns(joints: Sequence[JointResult]) -> Iterator[Sequence[JointResult]]:
    """Yield the joints of each column: joints of one robot and one unit, six at most."""
    groups: dict[tuple[str, str], list[JointResult]] = {}
    for joint in joints:
        groups.setdefault((joint.robot, joint.position.unit if joint.position else ""), []).append(joint)
    for group in groups.values():
        for start in range(0, len(group), _PER_COLUMN):
            yield group[start : start + _PER_COLUMN]


def _draw_panel(panel: Any, name: str, joints: Sequence[JointResult], result: SimulateResult) -> None:
    """Draw one quantity of some joints; near limits are dashed in the colour of the joint."""
    units = []
    times, drawn = result.series["time"], [getattr(joint, name) for joint in joints]
    for joint, quantity, colour in zip(joints, drawn, _COLOURS, strict=False):
        label = f"{joint.robot}: {joint.element}" if joint.robot not in ("", "robot") else joint.element
        values = result.series[quantity.variable] if quantity else [float("nan")] * len(times)
        panel.plot(times, values, color=colour, label=label, linewidth=1.3)
        if quantity:
            units.append(quantity.unit)
    low, high = panel.get_ylim()
    for quantity, colour in zip(drawn, _COLOURS, strict=False):
        for limit in _limits(quantity):
            if low - 0.5 * (high - low) <= limit <= high + 0.5 * (high - low):  # far limits would flatten the curves
                panel.axhline(limit, color=colour, linestyle="--", linewidth=0.8)
    panel.set_ylabel(f"{name} [{', '.join(dict.fromkeys(units))}]" if units else name)


def _limits(quantity: Range | None) -> list[float]:
    return [limit for limit in (quantity.lower, quantity.upper) if limit is not None] if quantity else []
