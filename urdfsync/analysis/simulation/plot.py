"""Draws positions, speeds and efforts of joints against their limits with matplotlib: a column for each six joints."""

from __future__ import annotations

import io
from collections.abc import Iterator, Sequence
from typing import Any

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from urdfsync.analysis.simulation.outcomes import QUANTITIES, CaseRange, Study
from urdfsync.analysis.simulation.results import JointResult, Range, SimulateResult
from urdfsync.common.diagnostics import ConfigError

_ROWS = ("position", "speed", "effort")
_PER_COLUMN = 6
_MOST = 12
"""The greatest number of series of a picture without joints."""
WIDTH, HEIGHT = 6.4, 2.6
"""Width and height of a panel, in inches."""
_LONGEST = 90
"""Letters that fit below a row of panels."""
PLAIN = {"svg.hashsalt": "urdfsync", "text.parse_math": False, "text.usetex": False}
"""No dates in SVG; `$` in the name of a joint begins no formula."""
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""The colours of Okabe and Ito, which colour-blind people can distinguish."""


def draw(result: SimulateResult, kind: str) -> bytes:
    """Return a picture, `png` or `svg`; the same result gives the same bytes.

    Without joints, the picture has the other series. Raises ConfigError for too many series.
    """
    series = [] if result.joints else [name for name in result.series if name != "time"]
    if not (result.joints or 0 < len(series) <= _MOST):
        message = f"the simulation has no joints, and {len(series)} variables: a picture has at most {_MOST}"
        raise ConfigError.of("no-plot", message, hint="name some with `--variable`")
    with rc_context({**PLAIN, "font.size": 9, "axes.grid": True, "grid.alpha": 0.3}):
        if series:
            return saved(_draw_series(result, series), kind)
        columns = list(_columns(result.joints))
        figure = Figure(figsize=(WIDTH * len(columns), HEIGHT * len(_ROWS)), layout="constrained")
        FigureCanvasAgg(figure)
        panels: Any = figure.subplots(len(_ROWS), len(columns), sharex=True, squeeze=False)
        figure.suptitle(f"{result.model}; dotted: {result.against.revision}" if result.against else result.model)
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
        return saved(figure, kind)


def draw_study(study: Study, kind: str) -> bytes:
    """Return a picture of all cases: for each joint how often its speed and effort have each size, and their limits.

    The last row has the load of each case over each varied parameter. At least one case must not have failed.
    """
    simulated = [number for number, outcome in enumerate(study.outcomes) if not outcome.problem]
    names = study.names
    width = max(len(names), len(study.varied.names), 1)
    with rc_context({**PLAIN, "font.size": 8, "axes.grid": True, "grid.alpha": 0.3}):
        figure = Figure(figsize=(max(2.2 * width, 6.4), 3 * HEIGHT), layout="constrained")
        FigureCanvasAgg(figure)
        figure.suptitle(f"{study.model}: {study.within} of {len(study.outcomes)} cases within all limits")
        rows = figure.add_gridspec(2, 1, height_ratios=(2, 1))
        panels: Any = rows[0].subgridspec(2, max(len(names), 1)).subplots(squeeze=False)
        for row, quantity in enumerate(("speed", "effort")):
            place = QUANTITIES.index(quantity)
            for panel, (column, joint) in zip(panels[row], enumerate(names), strict=False):
                extents = [study.outcomes[number].joints[column].extents[place] for number in simulated]
                _draw_sizes(panel, [extent for extent in extents if extent], joint.units[place])
                panel.set_title(f"{joint.short}: {quantity}", fontsize=8)
        panels = rows[1].subgridspec(1, len(study.varied.names)).subplots(squeeze=False, sharey=True)[0]
        for column, (panel, name) in enumerate(zip(panels, study.varied.names, strict=True)):
            for status, colour in (("within", COLOURS[2]), ("beyond", COLOURS[1])):
                chosen = [number for number in simulated if study.outcomes[number].status == status]
                values = [study.varied.rows[number][column] for number in chosen]
                loads = [study.outcomes[number].load for number in chosen]
                panel.plot(values, loads, ".", markersize=4, color=colour, label=f"{status} limits" if chosen else None)
            panel.axhline(1, color="black", linestyle="--", linewidth=0.8)
            panel.set_xlabel(name if len(name) * len(panels) < _LONGEST else f"…{name[-_LONGEST // len(panels) :]}")
        panels[0].set_ylabel("greatest share of a limit")
        panels[-1].legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
        return saved(figure, kind)


def _draw_sizes(panel: Any, extents: Sequence[CaseRange], unit: str) -> None:
    """Draw how many cases have each greatest absolute value, and the limit if it is near."""
    panel.set_visible(bool(extents))  # a joint that follows another has no effort
    sizes = [extent.size for extent in extents]
    panel.hist(sizes, bins=min(30, max(5, len(sizes) // 5)), color=COLOURS[0])
    limits = {extent.upper for extent in extents if extent.upper is not None}
    low, high = panel.get_xlim()
    for limit in limits if len(limits) == 1 else ():
        if limit <= high + 1.5 * (high - low):  # a far limit would flatten the bars
            panel.axvline(limit, color=COLOURS[1], linestyle="--", linewidth=1)
    panel.set_xlabel(unit)


def _draw_series(result: SimulateResult, names: Sequence[str]) -> Figure:
    figure = Figure(figsize=(2 * WIDTH, 2 * HEIGHT), layout="constrained")
    FigureCanvasAgg(figure)
    panel: Any = figure.subplots()
    figure.suptitle(result.model)
    for name in names:
        panel.plot(result.series["time"], result.series[name], label=name)
    panel.set_xlabel("time [s]")
    panel.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
    return figure


def saved(figure: Figure, kind: str) -> bytes:
    """Return a picture, `png` or `svg`; the same figure gives the same bytes."""
    figure.draw_without_rendering()  # places the panels
    figure.set_layout_engine("none")
    for panel in figure.findobj(Axes):
        # the solver of the layout differs in the last bits from run to run, which SVG would show
        left, bottom, width, height = (round(number, 4) for number in panel.get_position().bounds)
        panel.set_position((left, bottom, width, height))
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
    for joint, quantity, colour in zip(joints, drawn, COLOURS, strict=False):
        label = f"{joint.robot}: {joint.element}" if joint.robot not in ("", "robot") else joint.element
        values = result.series[quantity.variable] if quantity else [float("nan")] * len(times)
        panel.plot(times, values, color=colour, label=label, linewidth=1.3)
        if quantity and quantity.variable in result.former:
            former = result.former[quantity.variable]
            panel.plot(result.former["time"], former, color=colour, linestyle=":", linewidth=1.3)
        if quantity:
            units.append(quantity.unit)
    low, high = panel.get_ylim()
    for quantity, colour in zip(drawn, COLOURS, strict=False):
        for limit in _limits(quantity):
            if low - 0.5 * (high - low) <= limit <= high + 0.5 * (high - low):  # far limits would flatten the curves
                panel.axhline(limit, color=colour, linestyle="--", linewidth=0.8)
    panel.set_ylabel(f"{name} [{', '.join(dict.fromkeys(units))}]" if units else name)


def _limits(quantity: Range | None) -> list[float]:
    return [limit for limit in (quantity.lower, quantity.upper) if limit is not None] if quantity else []
