"""Coordinates of rows, columns and of the tracks for lines between them. This module knows no robot.

Lines consist of axis-parallel segments. All coordinates are even, y points upwards.
"""

from __future__ import annotations

import heapq
from collections.abc import Hashable, Iterable, Mapping, Sequence
from typing import TypeAlias, TypeVar

import msgspec

Point: TypeAlias = tuple[int, int]
Path: TypeAlias = tuple[Point, ...]

Key = TypeVar("Key", bound=Hashable)

SIZE = 20
"""Width and height of a component."""
CONNECTOR = 12
"""Width and height of a connector of the model that stands beside a component."""

_COLUMN = 48  # from trunk to trunk, as long as one track is enough in the gap between
_TRACK = 4  # distance of neighbouring lines
_BELOW = 44  # from a row's spine down to its end: link, its name, a gap
_NAME = 8  # room for a name above a component


class Placement(msgspec.Struct, frozen=True):
    """A component's rectangle in the diagram: lower left corner (x1, y1), upper right corner (x2, y2)."""

    x1: int
    y1: int
    x2: int
    y2: int

    @property
    def centre(self) -> Point:
        """The middle of the rectangle."""
        return (self.x1 + self.x2) // 2, (self.y1 + self.y2) // 2

    def at(self, icon: Point) -> Point:
        """Return the place in the diagram of a point of the icon's coordinate system, -100 to 100 both ways."""
        across = (self.x2 - self.x1) * (icon[0] + 100) // 200
        up = (self.y2 - self.y1) * (icon[1] + 100) // 200
        return self.x1 + across, self.y1 + up

    def moved(self, dx: int, dy: int) -> Placement:
        """Return the rectangle moved by `dx` and `dy`."""
        return Placement(self.x1 + dx, self.y1 + dy, self.x2 + dx, self.y2 + dy)


class RowNeeds(msgspec.Struct, frozen=True):
    """Contents of a row: tracks above it; whether it has couplings, connectors above joints, frames below links."""

    tracks: int
    band: bool
    drives: bool
    frames: bool


class Row(msgspec.Struct, frozen=True):
    """Heights of a row: its spine, the middle of its band, its tracks from the top; `bottom` is its end."""

    spine: int
    band: int
    tracks: Sequence[int]
    bottom: int


def rows(needs: Iterable[RowNeeds], top: int) -> list[Row]:
    """Stack rows downwards from `top`."""
    stacked: list[Row] = []
    for need in needs:
        lanes = [top - _TRACK * (index + 1) for index in range(need.tracks)]
        top -= _TRACK * len(lanes)
        middle = top - _NAME - SIZE // 2
        if need.band:
            top -= _NAME + SIZE
        if need.drives:
            top -= CONNECTOR + _TRACK
        spine = top - _NAME - SIZE // 2
        top = spine - _BELOW - (CONNECTOR + _TRACK if need.frames else 0)
        stacked.append(Row(spine, middle, lanes, top))
    return stacked


def trunks(gaps: Sequence[int], left: int) -> list[int]:
    """Return x of each column's trunk; `gaps` counts the tracks left of each, the first gap begins at x = `left`."""
    found = [left + _TRACK * (gaps[0] + 1)]
    for count in gaps[1:]:
        found.append(found[-1] + _COLUMN + _TRACK * max(0, count - 1))
    return found


def gap_track(trunk: int, track: int) -> int:
    """Return x of a numbered track in the gap left of a trunk."""
    return trunk - _TRACK * (track + 1)


def tracks(intervals: Mapping[Key, tuple[int, int]]) -> dict[Key, int]:
    """Number the tracks of a channel, from 0, so that closed intervals on one track don't touch.

    The left-edge method: as few tracks as the densest place of the channel needs.
    """
    assigned: dict[Key, int] = {}
    busy: list[tuple[int, int]] = []
    for key, (start, end) in sorted(intervals.items(), key=lambda item: item[1]):
        track = heapq.heappop(busy)[1] if busy and busy[0][0] < start else len(busy)
        assigned[key] = track
        heapq.heappush(busy, (end, track))
    return assigned


def square(centre: Point, size: int = SIZE) -> Placement:
    """Return a square around `centre`."""
    half = size // 2
    return Placement(centre[0] - half, centre[1] - half, centre[0] + half, centre[1] + half)


def path(points: Iterable[Point]) -> Path:
    """Return the polyline without repeated points and without points inside a straight run."""
    kept: list[Point] = []
    for point in points:
        if kept and point == kept[-1]:
            continue
        if len(kept) > 1 and _straight(kept[-2], kept[-1], point):
            kept.pop()
        kept.append(point)
    return tuple(kept)


def _straight(a: Point, b: Point, c: Point) -> bool:
    return a[0] == b[0] == c[0] or a[1] == b[1] == c[1]
