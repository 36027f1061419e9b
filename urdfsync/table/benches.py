"""Names the model that simulates a package of a table; `urdfsync.domain.bench.Benches` describes the function."""

from __future__ import annotations

from urdfsync.domain import Target
from urdfsync.domain.bench import Bench
from urdfsync.table.model import Table, TableOptions


def bench(snapshot: Table, target: Target, options: TableOptions) -> Bench | None:  # noqa: ARG001 - see `Benches`
    """Return the model of the whole system; None if the options choose no such model."""
    return Bench(target.name, "", ()) if "system" in options.files else None
