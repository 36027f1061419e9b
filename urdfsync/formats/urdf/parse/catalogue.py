"""Reads a catalogue: each row has the numbers of one motor, such as rotor, gear and limits.

The option `motors` names a row for a joint. The numbers of the row replace those of the joint.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple, get_args

from msgspec.structs import replace

from urdfsync.common.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.common.spelling import name_and_unit, nearest
from urdfsync.domain import Companion
from urdfsync.formats.urdf.options import MotorNumber, Options
from urdfsync.formats.urdf.parse.fields import Reader
from urdfsync.formats.urdf.robot import MOTION_KINDS, Dynamics, Joint, Limit, Motor, Transmission, UnitName, unit_of
from urdfsync.formats.urdf.validate import diagnostic

_EMPTY = {"limit": Limit(), "dynamics": Dynamics(), "transmission": Transmission()}


def _units(unit: UnitName) -> tuple[str, str]:
    """Return the units of a turning and of a sliding joint, as tables write units."""
    turning, sliding = (
        name.replace("·", ".").replace("²", "2") or "1" for name in (unit.name, unit.sliding or unit.name)
    )
    return turning, sliding


_PLACES: Mapping[MotorNumber, tuple[str, str, str]] = {
    number: (field, *_units(unit_of(type(part), number)))
    for number in get_args(MotorNumber)
    for field, part in _EMPTY.items()
    if hasattr(part, number)
}
"""Numbers of a row: the field of `Joint` with the number, and the units of a turning and of a sliding joint."""
NUMBERS: Mapping[tuple[str | int, ...], str] = {(field, number): number for number, (field, _, _) in _PLACES.items()}
"""Numbers of a row by their paths in a joint."""


class CatalogueRow(NamedTuple):
    """A row of the catalogue for one joint, as written."""

    motor: str
    cells: Mapping[MotorNumber, tuple[str, str]]
    """Text and unit of each number."""
    unused: Sequence[str]
    """Filled columns of numbers that no joint takes."""
    file: str
    line: int


def read_rows(catalogue: Companion, options: Options) -> Mapping[str, CatalogueRow]:
    """Return the row of each joint in `motors`. The check of options reports missing rows.

    Raises SourceError for any other fault of the table.
    """
    from urdfsync.formats.table.formats import read_sheets, with_decimal_points  # a late import saves most robots 9 ms

    file, (sheet, _) = catalogue.file, read_sheets(catalogue.content, catalogue.file)
    header = [name_and_unit(cell) for cell in sheet.header]
    sheet = with_decimal_points(sheet, [n for n, (_, unit) in enumerate(header) if unit not in ("", "text")])
    names, columns = [name for name, _ in header], dict[MotorNumber, Sequence[str]]()
    for number in _PLACES:
        named = options.motor_columns.get(number, number)
        columns[number] = (named,) if isinstance(named, str) else named
        if missing := [column for column in columns[number] if column not in names and column != number]:
            near = nearest(missing[0], names)
            hint = f"did you mean `{near}`?" if near else "correct `motor_columns`"
            raise SourceError.of("no-column", f"there is no column `{missing[0]}`", file, 1, hint=hint)
    lines, found = dict[str, tuple[int, list[str]]](), dict[str, CatalogueRow]()
    for line, cells in sheet.rows:
        texts = ["" if cell is None else str(cell).strip() for cell in cells]
        if texts[0] in lines and texts[0] in options.motors.values():
            message = f"the row `{texts[0]}` stands in line {lines[texts[0]][0]}, too"
            raise SourceError.of("bad-row", message, file, line, hint="rename one")
        lines[texts[0]] = line, texts
    for joint, name in options.motors.items():
        line, texts = lines.get(name, (0, names))
        if len(texts) != len(names):
            message = f"the row `{name}` has {len(texts)} cells, but the header has {len(names)}"
            raise SourceError.of("bad-row", message, file, line, hint="fill each cell, or quote its text")
        filled = {column: (_printable(text), unit) for (column, unit), text in zip(header, texts, strict=True) if text}
        own = dict[MotorNumber, tuple[str, str]]()
        for number, alternatives in columns.items():
            if column := next(filter(filled.__contains__, alternatives), ""):
                own[number] = filled.pop(column)
                if not own[number][1]:
                    message, hint = f"the column `{column}` has no unit", f"write `{column} [{_PLACES[number][1]}]`"
                    raise SourceError.of("bad-row", message, file, 1, hint=hint)
        unused = [column for column, unit in header if column in filled and unit not in ("", "text")]
        if name in lines:
            found[joint] = CatalogueRow(_printable(name), own, unused, file, line)
    return found


def _printable(text: str) -> str:
    return "".join(filter(str.isprintable, text))


def with_rows(reader: Reader, joints: Sequence[Joint], rows: Mapping[str, CatalogueRow]) -> list[Joint]:
    """Return the joints with the numbers of their rows.

    A row of a joint without an axis is ignored: the check of options reports this row. Only the first fault becomes a
    diagnostic, since a wrong unit is a fault in each row.
    """
    found = list(joints)
    for number, joint in enumerate(joints):
        row = rows.get(joint.name)
        if row is None or joint.type not in MOTION_KINDS:
            continue
        try:
            found[number] = _with_row(joint, row)
        except SourceError as error:
            reader.diagnostics += [replace(fault, file=row.file, line=row.line) for fault in error.diagnostics]
            break
        if (limit := found[number].limit) is None:
            continue
        is_zero = "velocity" in row.cells and limit.velocity == 0
        faults = [("zero-limits", "velocity = 0: the joint may not move")] if is_zero else []
        if joint.limit is None and reader.version < (1, 2):
            missing = [name for name in ("effort", "velocity") if name not in row.cells]
            faults += [("missing-limit-value", f"no {name}, taken as unlimited") for name in missing]
        for code, fault in faults:
            entry = diagnostic(code, f"joint {joint.name} / limit has {fault}", row.line)
            reader.diagnostics.append(replace(entry, file=row.file))
    return found


def find_gaps(joints: Sequence[Joint], rows: Mapping[str, CatalogueRow]) -> Iterator[Diagnostic]:
    """Yield a note on the columns that no joint takes, and one for each cell that is filled only in other rows.

    The cell of an effort or a velocity counts, if a row of another such joint has one.
    """
    if unused := dict.fromkeys(name for row in rows.values() for name in row.unused):
        message = f"no joint takes these columns of the catalogue: {', '.join(f'`{name}`' for name in unused)}"
        hint = "name a column in `motor_columns` if it is a number of a drive"
        first = next(row for row in rows.values() if row.unused)
        yield Diagnostic(Severity.NOTE, "unused", message, first.file, first.line, hint=hint)
    driven = [(joint, rows[joint.name]) for joint in joints if joint.motor]
    numbers: tuple[MotorNumber, ...] = ("effort", "velocity")
    for number in numbers:
        filled = {MOTION_KINDS[joint.type] for joint, row in driven if number in row.cells}
        for joint, row in driven:
            if MOTION_KINDS[joint.type] in filled and number not in row.cells:
                message = f"the row `{row.motor}` has no {number}: that of joint `{joint.name}` in the source counts"
                yield Diagnostic(Severity.NOTE, "empty-cell", message, row.file, row.line, hint="fill the cell")


def _with_row(joint: Joint, row: CatalogueRow) -> Joint:
    """Return a joint with the numbers of its row. Raises SourceError."""
    if not row.cells:
        hint = "fill cells of the row, or name columns in `motor_columns`"
        raise SourceError.of("bad-row", f"the row `{row.motor}` has no number of a drive", hint=hint)
    parts: dict[str, Any] = {}
    for number, cell in row.cells.items():
        field, *units = _PLACES[number]
        if field == "limit" and joint.limit is None and joint.type != "continuous":
            message = f"joint `{joint.name}` has no <limit>: the row `{row.motor}` gives no limits of position"
            raise SourceError.of("bad-row", message, hint="write the joint's <limit> in the URDF")
        try:
            size = _in_si(number, cell, units[MOTION_KINDS[joint.type] == "translational"])
        except ValueError as error:
            message = f"{number} of joint `{joint.name}` in the row `{row.motor}`: {error}"
            raise SourceError.of("bad-row", message, hint="correct the catalogue, or `motor_columns`") from None
        part = parts.get(field) or getattr(joint, field) or _EMPTY[field]
        parts[field] = replace(part, **{number: size})
        if number == "reduction" and joint.transmission and joint.transmission.joint is not None:
            other = joint.transmission.joint
            message = f"the motor of joint `{joint.name}` also moves `{other}`: a row can't give its reduction"
            raise SourceError.of("bad-row", message, hint="leave the cell of the reduction empty")
    if parts.get("transmission") == Transmission():
        del parts["transmission"]
        joint = replace(joint, transmission=None)
    return replace(joint, motor=Motor(row.motor, tuple(row.cells)), **parts)


def _in_si(number: MotorNumber, cell: tuple[str, str], expected: str) -> float:
    """Return a text with its unit, such as `410` in `N.cm`, in an expected unit. Raises ValueError or SourceError."""
    from urdfsync.formats.table.reading import read_value  # a late import saves most robots 15 ms
    from urdfsync.formats.table.units import find_unit, is_same_kind

    text, unit = cell
    unit = "1" if unit == "integer" else unit
    if not is_same_kind(unit, expected):
        raise ValueError(f"{unit} can't be converted to {expected}")
    found = find_unit(unit)
    if expected.startswith("rad") and "rad" not in found.si:  # pint reads 1/min as rad/min, data sheets mean rpm
        raise ValueError(f"write `turn` or `rad` in {unit}")
    size = float(read_value(text, found) or 0)
    if size < 0 if number != "reduction" else not size:
        raise ValueError(f"{text} is too small")
    return size
