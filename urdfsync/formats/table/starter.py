"""What `init` writes for a new table, and what `simulate` simulates of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from urdfsync.common.diagnostics import Diagnostic
from urdfsync.domain import Target
from urdfsync.domain.advice import Proposal
from urdfsync.domain.bench import Bench
from urdfsync.formats.table.model import Table, TableOptions


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
    names = "record", "model", *(["system"] if snapshot.connections else [])
    return {f"{name}.mo.jinja": (shipped / f"{name}.mo.jinja").read_text(encoding="utf-8") for name in names}


def bench(snapshot: Table, target: Target, options: TableOptions) -> Bench | None:  # noqa: ARG001 - see `Benches`
    """Return the model of the whole system; None if the options choose no such model."""
    return Bench(target.name, "", ()) if "system" in options.files else None
