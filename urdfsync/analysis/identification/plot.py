"""Draws the efforts of joints in a log with matplotlib: measured, by the model, and by the model after the fit."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from urdfsync.analysis.identification.results import Identification
from urdfsync.analysis.simulation.plot import COLOURS, HEIGHT, PLAIN, WIDTH, saved


def draw(result: Identification, kind: str) -> bytes:
    """Return a picture, `png` or `svg`: for each joint its efforts on the left, and what the model leaves on the right.

    The picture has the filtered efforts of the stored samples. Gaps of the log are gaps of the curves, and samples that
    the fit does not use are gaps on the right.
    """
    series, joints = result.series, result.joints
    usual = np.median(np.diff(series.times))
    gaps = np.flatnonzero(np.diff(series.times) > 3 * usual) + 1
    times = np.insert(series.times - series.times[0], gaps, np.nan)
    is_used = np.where(series.is_used, 1.0, np.nan)
    curves = *series[1:4], *((series.measured - each) * is_used for each in series[2:4])
    measured, before, after, left_before, left_after = (np.insert(each, gaps, np.nan, axis=0) for each in curves)
    with rc_context({**PLAIN, "font.size": 9, "axes.grid": True, "grid.alpha": 0.3}):
        figure = Figure(figsize=(2 * WIDTH, HEIGHT * len(joints) * 0.8 + 0.6), layout="constrained")
        FigureCanvasAgg(figure)
        figure.suptitle(f"{result.robot}: {result.log}")
        panels: Any = figure.subplots(len(joints), 2, sharex=True, squeeze=False)
        for (left, right), joint, column in zip(panels, joints, range(measured.shape[1]), strict=True):
            left.plot(times, measured[:, column], color="black", linewidth=1.6, label="measured")
            left.plot(times, before[:, column], color=COLOURS[1], linewidth=1, label="before")
            left.plot(times, after[:, column], color=COLOURS[0], linewidth=1, linestyle="--", label="after")
            right.plot(times, left_before[:, column], color=COLOURS[1], linewidth=1, label="before")
            right.plot(times, left_after[:, column], color=COLOURS[0], linewidth=1, label="after")
            left.set_ylabel(f"{joint.element.partition(' ')[2]} [{joint.unit}]")
            right.set_title(f"unexplained: {joint.before:.3g} before, {joint.after:.3g} after (RMS)", fontsize=8)
        for panel in panels[-1]:
            panel.set_xlabel("time [s]")
        panels[0][0].legend(loc="upper right", frameon=False, ncols=3)
        return saved(figure, kind)
