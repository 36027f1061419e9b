"""Reads the companions of a URDF a second time, for the second reading and for Pinocchio: the YAML and the catalogue.

Only the format of the catalogue is read by the code of the first reading.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple, get_args

from urdfsync.domain import Companion
from urdfsync.formats.urdf.options import MotorNumber, Options

PATHS = {
    **{name: f"limits.{name}" for name in ("effort", "velocity")},
    **{name: f"dynamics.{name}" for name in ("damping", "friction", "armature")},
    "reduction": "transmission.reduction",
    "rotor_inertia": "transmission.rotorInertia",
}
"""Numbers of a row, and their paths in records."""


class CompanionLine(NamedTuple):
    """A line of a companion."""

    file: str
    sourceline: int
    """Has the name of the line in elements of lxml."""


class CatalogueNumbers(NamedTuple):
    """The numbers of a joint in the catalogue, in SI."""

    numbers: Mapping[str, float]
    place: CompanionLine


class Companions(NamedTuple):
    """The statements of the companions of a URDF."""

    loops: Sequence[tuple[str, str, str, str, CompanionLine]] = ()
    """Name, kind and links of each loop."""
    motors: Sequence[tuple[str, CompanionLine]] = ()
    axes: Mapping[str, str] = {}
    """Axes of joints, such as `xyz`; a joint without axes is fixed."""
    rows: Mapping[str, CatalogueNumbers] = {}


def read_companions(companions: Iterable[Companion], options: Options) -> Companions:
    """Return the statements of all companions."""
    stated = Companions()
    for companion in companions:
        if companion.option == "catalogue":
            stated = stated._replace(rows=_read_rows(companion, options))
        else:
            loops, motors, axes = _parse_yaml(companion)
            stated = stated._replace(loops=loops, motors=motors, axes=axes)
    return stated


def _parse_yaml(
    companion: Companion,
) -> tuple[list[tuple[str, str, str, str, CompanionLine]], list[tuple[str, CompanionLine]], Any]:
    """Return the loops, the motors and the joints of several axes in a YAML."""
    import yaml  # a late import saves most robots 20 ms

    root = yaml.compose(companion.content, yaml.BaseLoader)
    pairs = root.value if root is not None and root.id == "mapping" else ()
    nodes = {key.value: value for key, value in pairs if key.id == "scalar"}
    keys = ("closed_loop", "type", "name_mot", "joint_name", "joint_type")
    lists = {key: nodes[key].value if key in nodes and nodes[key].id == "sequence" else () for key in keys}

    def place(node: Any) -> CompanionLine:
        return CompanionLine(companion.file, node.start_mark.line + 1)

    loops, axes = list[tuple[str, str, str, str, CompanionLine]](), dict[str, str]()
    for pair, kind in zip(lists["closed_loop"], lists["type"], strict=True):
        ends, word = [end.value for end in pair.value], {"3d": "ball", "6d": "fixed"}[kind.value.lower()]
        loops.append(("_".join(ends), word, ends[0], ends[1], place(pair)))
    for joint, kind in zip(lists["joint_name"], lists["joint_type"], strict=True):
        letters = kind.value.removeprefix("UJOINT_").lower()
        axes[joint.value] = {"fixed": "", "spherical": "xyz"}.get(letters, letters)
    return loops, [(joint.value, place(joint)) for joint in lists["name_mot"]], axes


def _read_rows(companion: Companion, options: Options) -> dict[str, CatalogueNumbers]:
    """Return the row of each joint that `motors` names.

    The first filled column of each number counts; of columns with the same name, the last filled one.
    """
    from urdfsync.formats.table.formats import read_sheets  # a late import saves most robots 20 ms

    sheet, _ = read_sheets(companion.content, companion.file)
    texts = ((line, ["" if cell is None else str(cell).strip() for cell in cells]) for line, cells in sheet.rows)
    lines, rows = {cells[0]: (line, cells) for line, cells in texts}, dict[str, CatalogueNumbers]()
    for joint, motor in options.motors.items():
        (line, cells), filled, numbers = lines[motor], dict[str, tuple[str, str]](), dict[str, float]()
        for title, text in zip(map(str.strip, sheet.header), cells, strict=False):
            name, _, unit = title[:-1].rpartition("[") if title.endswith("]") and "[" in title else (title, "", "")
            if text:
                filled[name.strip()] = "".join(filter(str.isprintable, text)), unit.strip()
        for number in get_args(MotorNumber):
            named = options.motor_columns.get(number, number)
            for name in [name for name in ([named] if isinstance(named, str) else named) if name in filled][:1]:
                numbers[number] = _in_si(*filled[name])
        rows[joint] = CatalogueNumbers(numbers, CompanionLine(companion.file, line))
    return rows


@functools.lru_cache(maxsize=256)  # pint's registry takes 0.3 s
def _in_si(number: str, unit: str) -> float:
    """Return a number with a unit, such as `N.cm`, in SI."""
    try:
        import pint
    except ImportError:
        return float(number)  # without pint, the first reading refuses all units but SI units
    torque = re.sub(r"\b([mk]?N)([cm]?m)\b", r"\1.\2", unit.replace("integer", "1"))
    torque = re.sub(r"\boz(?:f|)[-.]in\b", "ozf*in", torque)
    product = re.sub(r"(?<=[^\W\d])\.", "*", torque)
    one: Any = pint.Quantity(re.sub(r"(?<=[A-Za-z])(-?\d)", r"**\1", product))
    return float(number) * float(one.to_base_units().magnitude)
