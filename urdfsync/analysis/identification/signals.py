"""Filters and differentiates pieces of a log, and makes the samples that a fit uses.

Both filters have no phase. A Butterworth filter, forwards and backwards, goes over positions, since it leaves slow
motions as they are. Splines through the filtered positions give velocities and accelerations. A Gaussian filter goes
over efforts and over the model's efforts, so that both lose the same. It does not ring: dry friction jumps where a
joint turns back, and the samples around the jump, which no model explains, are few. FIGAROH and FloBaRoID filter by
Butterworth and differentiate by central differences, at the full rate.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np

from urdfsync.analysis.identification.log import LogPiece
from urdfsync.domain.regressor import Array, Axis

SHIFTS = np.linspace(-0.1, 0.1, 21)
"""Times in s by which efforts are moved against positions, to find a delay."""
_ORDER = 4
_WIDER = 3
"""The cut-off frequency of positions, in that of efforts: what it takes away from accelerations, efforts still have."""
_PER_CUTOFF = 20
"""The model is computed so many times in each period of the cut-off frequency; the filter then takes away its jumps."""
_KEPT = 4
"""So many samples remain in each period."""
_OF_MOTION = 10
"""The cut-off frequency, in frequencies below which the positions have 99 % of their power."""
_STILL = 0.003
"""In rad or m · 10: a joint whose positions deviate less from their mean rests."""
_MOVES = 0.1
"""A joint moves in a piece if its positions deviate by more than this share of their greatest deviation."""
_LONG = 0.2
"""In the duration of the longest piece in which a joint moves: shorter ones do not choose the cut-off frequency."""
_SLOW = 0.05
"""In rad/s or m/s · 10: below, dry friction holds a joint, and its effort has any value."""
_HELD = 0.001
"""The greatest part that efforts without a meaning may have in a filtered sample."""
_FLAT = 5
"""So many equal greatest efforts in a row are a saturation."""


class Samples(NamedTuple):
    """Filtered samples; a column for each axis."""

    times: Array
    q: Array
    v: Array
    a: Array
    efforts: Array
    """For each of `SHIFTS` the efforts that the log has so much later; the last axis is the joint."""
    is_free: np.ndarray
    """Whether an effort is neither saturated nor held by dry friction."""
    rate: float


def find_cutoff(pieces: Iterable[LogPiece], axes: Sequence[Axis], measured: Sequence[int]) -> float:
    """Return the cut-off frequency in Hz for a motion: that of the fastest piece and joint of those that move."""
    seconds, sizes, cutoffs = list[float](), list[list[float]](), list[list[float]]()
    still = np.array([_STILL if axes[k].unit == "rad" else 0.1 * _STILL for k in measured])
    for piece in pieces:
        found = [_cutoff(piece.times, piece.position[:, k]) for k in measured]
        seconds.append(piece.times[-1] - piece.times[0])
        sizes.append([float(np.std(piece.position[:, k])) for k in measured])
        cutoffs.append([cutoff if seconds[-1] >= 4 * _border(cutoff) else 0.0 for cutoff in found])
    if not seconds:
        return 1.0
    size, cutoff = np.array(sizes), np.array(cutoffs)
    moves = (size > _MOVES * size.max(axis=0)) & (size > still) & (cutoff > 0)
    length = np.array(seconds)[:, None] * moves
    # the frequencies of a short piece are those of its length
    chosen = cutoff[moves & (length >= _LONG * length.max(axis=0))]
    return float(chosen.max()) if chosen.size else max(1.0, float(cutoff.max()))


def _cutoff(measured_at: Array, positions: Array) -> float:
    times = np.linspace(measured_at[0], measured_at[-1], len(measured_at))
    step, values = times[1] - times[0], np.interp(times, measured_at, positions)
    power = np.abs(np.fft.rfft((values - values.mean()) * np.hanning(len(values)))) ** 2
    above = np.searchsorted(np.cumsum(power), 0.99 * power.sum())
    return float(np.clip(_OF_MOTION * np.fft.rfftfreq(len(values), step)[above], 1.0, 0.1 / step))


def _border(cutoff: float) -> float:
    """Return the time in s that a piece loses at each end."""
    return float(SHIFTS[-1] + 1.5 / cutoff)


def prepare(piece: LogPiece, axes: Sequence[Axis], cutoff: float) -> Samples | None:
    """Return the samples of a piece; None if it is shorter than the filter."""
    from scipy.interpolate import CubicSpline  # these imports take 0.5 s
    from scipy.signal import butter, sosfiltfilt

    count = len(piece.times)
    rate = (count - 1) / (piece.times[-1] - piece.times[0])
    times = np.linspace(piece.times[0], piece.times[-1], count)
    sections = butter(_ORDER, min(_WIDER * cutoff, 0.45 * rate), fs=rate, output="sos")
    border = _border(cutoff)
    if times[-1] - times[0] < 4 * border or cutoff >= rate / 2:
        return None

    def smooth(values: Array) -> Array:
        return np.array(sosfiltfilt(sections, values, axis=0))

    curve = CubicSpline(piece.times, piece.position)
    position = CubicSpline(times, smooth(curve(times)))
    speeds = piece.velocity
    velocity = position.derivative() if speeds is None else CubicSpline(times, smooth(_at(times, piece.times, speeds)))
    raw = _at(times, piece.times, piece.effort)
    effort, slow = (
        CubicSpline(times, _blurred(raw, cutoff / rate)),
        [_SLOW if axis.unit == "rad" else 0.1 * _SLOW for axis in axes],
    )
    # the filter spreads an effort that has any value over its neighbours
    held = _blurred((_saturated(raw, axes) | (np.abs(velocity(times)) < slow)).astype(float), cutoff / rate)
    even = min(rate, _PER_CUTOFF * cutoff)
    chosen = np.arange(times[0] + border / 3, times[-1] - border / 3, 1 / even)
    inside = np.clip(chosen[None, :] + SHIFTS[:, None], times[0], times[-1])
    is_free = _at(chosen, times, held) < _HELD
    return Samples(chosen, position(chosen), velocity(chosen), velocity(chosen, 1), effort(inside), is_free, even)


def thinned(samples: Samples, cutoff: float, rows: Array, model: Array) -> tuple[np.ndarray, Array, Array]:
    """Return the places of the samples that remain, and the filtered rows of the model there."""
    border = round(_border(cutoff) * samples.rate)
    step = max(1, round(samples.rate / (_KEPT * cutoff)))
    places, share = np.arange(border, len(samples.times) - border, step), cutoff / samples.rate
    return places, _blurred(rows, share)[places], _blurred(model, share)[places]


def _blurred(values: Array, cutoff: float) -> Array:
    """Filter columns by a Gaussian that halves the cut-off frequency, which is in units of the sampling rate."""
    from scipy.ndimage import gaussian_filter1d

    return np.asarray(gaussian_filter1d(values, np.sqrt(2 * np.log(2)) / (2 * np.pi * cutoff), axis=0, truncate=5.0))


def target_at(delay: float) -> Array:
    """Return the combination of efforts at `SHIFTS`, and of the model's, that a fit explains at a delay."""
    middle, part = _parabola(delay)
    weights = np.zeros(len(SHIFTS))
    weights[middle - 1 : middle + 2] = 0.5 * part * (part - 1), 1 - part * part, 0.5 * part * (part + 1)
    return np.array([*weights, -1.0])


def shift_slopes(delay: float) -> Array:
    """Return the derivative of the efforts' combination by the delay."""
    middle, part = _parabola(delay)
    weights = np.zeros(len(SHIFTS))
    weights[middle - 1 : middle + 2] = part - 0.5, -2 * part, part + 0.5
    return np.asarray(weights / (SHIFTS[1] - SHIFTS[0]))


def _parabola(delay: float) -> tuple[int, float]:
    middle = int(np.clip(np.abs(SHIFTS - delay).argmin(), 1, len(SHIFTS) - 2))
    return middle, (delay - SHIFTS[middle]) / (SHIFTS[1] - SHIFTS[0])


def alike(residuals: Array) -> float:
    """Return the number of neighbouring residuals that tell one thing: 1 for independent ones."""
    values = residuals - residuals.mean()
    power = np.abs(np.fft.rfft(values, 2 * len(values))) ** 2
    products = np.fft.irfft(power)[: len(values) // 4]
    if products[0] <= 0:
        return 1.0
    products = products / products[0]
    ends = np.flatnonzero(products < 0)  # beyond the first zero, sums are noise
    return float(max(1.0, 2 * products[: ends[0] if len(ends) else None].sum() - 1))


def _at(times: Array, old: Array, values: Array) -> Array:
    return np.column_stack([np.interp(times, old, column) for column in values.T])


def _saturated(efforts: Array, axes: Sequence[Axis]) -> np.ndarray:
    """Return which efforts are at their limit, or on a flat top; all of a joint whose effort is always 0."""
    sizes = np.abs(efforts)
    tops = sizes >= sizes.max(axis=0) * (1 - 1e-9)
    runs = np.lib.stride_tricks.sliding_window_view(tops, _FLAT, axis=0).all(axis=-1).any(axis=0)
    return np.asarray((tops & runs) | (sizes >= [0.999 * axis.effort for axis in axes]))
