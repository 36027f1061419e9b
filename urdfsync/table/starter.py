"""Templates and options that `init` writes for a new table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from urdfsync.config.advice import Proposal
from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import Target
from urdfsync.table.model import Table
from urdfsync.table.names import column_name


def propose(snapshot: Table, diagnostics: Sequence[Diagnostic]) -> Sequence[Proposal]:  # noqa: ARG001 - see `Advice`
    """Return the files that suit a table; see `Advice`."""
    if not snapshot.connections:
        return ()
    return (Proposal("files", ("record", "model", "system"), "the table has connections"),)


def option_for(name: str, snapshot: Table, target: Target, options: Any) -> str:  # noqa: ARG001 - see `Advice`
    """Return nothing: no option brings a name back; see `Advice`."""
    return ""


def templates(snapshot: Table) -> Mapping[str, str]:
    """Return templates for the columns of a table, by path. The user edits these templates."""
    declarations = [line for column in snapshot.columns for line in _declare(snapshot, column)]
    record = "\n".join([_RECORD, *declarations, "", "end << class >>;", ""])
    files = {"record.mo.jinja": record, "model.mo.jinja": _MODEL}
    return files | ({"system.mo.jinja": _SYSTEM} if snapshot.connections else {})


def _declare(snapshot: Table, column: str) -> list[str]:
    """Return the lines that declare a column; a condition leaves out elements with an empty cell."""
    name, kind = column_name(column), snapshot.columns[column]
    cells = [row[column] for row in snapshot.elements.values() if column in row]
    if not cells:
        return []
    of_column = f".{column}" if column.isidentifier() else f"[{column!r}]"
    cell, head, value = f"row{of_column}", f"Real {name}(unit = << units{of_column} | string >>)", "{} | real"
    head, value = _DECLARATIONS.get(kind, (head, value))
    declaration = f"  parameter {head.format(name)} = << {value.format(cell)} >>;"
    if len(cells) == len(snapshot.elements):
        return ["", declaration]
    return [f"<% if {cell} is defined %>", "", declaration, "<% endif %>"]


_DECLARATIONS = {
    "text": ("String {}", "{} | string"),
    "integer": ("Integer {}", "{}"),
    "boolean": ("Boolean {}", "{} | lower"),
}
"""Types without a unit, with declaration and value."""
_RECORD = """\
within << within >>;

record << class >> << ("Numbers of " ~ name) | string >>
  extends Modelica.Icons.Record;"""
_MODEL = """\
within << within >>;

model << class >> << name | string >>

  parameter Records.<< class >> parameters
    "Numbers of the element";

end << class >>;
"""
_SYSTEM = """\
within << within >>;

model << class >> "All elements, connected"
<% for element in elements %>

  Models.<< element.class >> << element.component >>
    << element.name | string >>;
<% endfor %>

equation
  // connections name the connectors of your models: connect(a.port_b, b.port_a);
<% for connection in connections %>
  // << connection.start.component >> to << connection.end.component >>
<% endfor %>

end << class >>;
"""
