"""Templates and options for a new table, for `init`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from urdfsync.config.advice import Proposal
from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import Target
from urdfsync.table.model import Table
from urdfsync.table.names import component_name


def propose(snapshot: Table, diagnostics: Sequence[Diagnostic]) -> Sequence[Proposal]:  # noqa: ARG001 - see `Advice`
    """Return the files that suit a table; see `Advice`."""
    if not snapshot.connections:
        return ()
    return (Proposal("files", ("record", "model", "system"), "the table has connections"),)


def option_for(name: str, snapshot: Table, target: Target, options: Any) -> str:  # noqa: ARG001 - see `Advice`
    """Return nothing: no option brings a name back; see `Advice`."""
    return ""


def templates(snapshot: Table) -> Mapping[str, str]:
    """Return templates for the columns of a table, to be edited, by their paths."""
    columns = dict.fromkeys(column for row in snapshot.elements.values() for column in row)
    lines = [line for column in columns for line in _declaration(snapshot, column)]
    record = [*lines, "", "end << class >>;", ""]
    files = {
        "record.mo.jinja": '\n'.join(['within << within >>;', '', 'record << class >> << ("Numbers of " ~ name) | string >>', '  extends Modelica.Icons.Record;', *record]),
        "model.mo.jinja": _MODEL,
    }
    return files | ({"system.mo.jinja": _SYSTEM} if snapshot.connections else {})


def _declaration(snapshot: Table, column: str) -> list[str]:
    """Return the lines that declare a column in the record, unless its cell is empty."""
    name, cell = component_name(column, "column"), f"row[{column!r}]"
    values = [row[column] for row in snapshot.elements.values() if row[column] is not None]
    if column in snapshot.units["elements"]:
        declaration = f'parameter Real {name}(final unit = "{snapshot.units["elements"][column]}") = << {cell} | real >>;'
    elif values and isinstance(values[0], bool):
        declaration = f"parameter Boolean {name} = << {cell} | lower >>;"
    elif values and isinstance(values[0], int):
        declaration = f"parameter Integer {name} = << {cell} >>;"
    else:
        declaration = f"parameter String {name} = << {cell} | string >>;"
    if len(values) == len(snapshot.elements):
        return ["", f"  {declaration}"]
    return [f"<% if {cell} is not none %>", "", f"  {declaration}", "<% endif %>"]


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
