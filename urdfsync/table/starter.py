"""Templates and options that `init` writes for a new table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import Target
from urdfsync.domain.advice import Proposal
from urdfsync.table.model import Table


def propose(snapshot: Table, diagnostics: Sequence[Diagnostic]) -> Sequence[Proposal]:  # noqa: ARG001 - see `Advice`
    """Return the files that suit a table; see `Advice`."""
    if not snapshot.connections:
        return ()
    return (Proposal("files", ("record", "model", "system"), "the table has connections"),)


def option_for(name: str, snapshot: Table, target: Target, options: Any) -> str:  # noqa: ARG001 - see `Advice`
    """Return nothing: no option brings a name back; see `Advice`."""
    return ""


def templates(snapshot: Table, shipped: Path) -> Mapping[str, str]:
    """Return templates for a table, by path; `shipped` is the domain's folder. The user edits these templates."""
    # the shipped template loops over the columns: a column of a later export needs no edit
    files = {name: (shipped / name).read_text(encoding="utf-8") for name in ("record.mo.jinja", "model.mo.jinja")}
    return files | ({"system.mo.jinja": _SYSTEM} if snapshot.connections else {})


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
