"""How it is shown where the time of a command went."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from urdfsync.output.console import text
from urdfsync.profiling import OTHER, STAGES, Profile

if TYPE_CHECKING:
    from rich.console import RenderableType

_WORDS = {
    "start": "start-up",
    "imports": "imports of domain and templates",
    "stamp": "asking the stamp",
    "looking": "looking at files",
    "reading": "reading the source",
    "cross-check": "second reader",
    "recording": "recording the state",
    "waiting": "waiting for processes",
    OTHER: "everything else",
}
"""What stages are called, if not by their name."""
_COUNTS = {
    "read": "files read",
    "rendered": "texts rendered",
    "written": "files written, those of the state included",
}
_LEAST = 50_000
"""Nanoseconds: shorter stages are left out."""


def parts(profile: Profile) -> Iterator[RenderableType]:
    """A table of all stages that took time, what was done, and whether a stamp would have been enough."""
    from rich import box
    from rich.table import Table

    here, counts = profile.results()
    total = sum(here.values())
    table = Table(box=box.SIMPLE_HEAD, show_footer=True)
    table.add_column("stage", footer="total")
    table.add_column("ms", justify="right", footer=_ms(total))
    table.add_column("share", justify="right")
    if profile.elsewhere:
        table.add_column("ms in other processes", justify="right", footer=_ms(sum(profile.elsewhere.values())))
    for name in (*STAGES, OTHER):
        own, others = here.get(name, 0), profile.elsewhere[name]
        if max(own, others) >= _LEAST:
            beside = [_ms(others)] if profile.elsewhere else []
            table.add_row(_WORDS.get(name, name), _ms(own), f"{own / total:.0%}", *beside)
    yield table
    if counts:
        yield text((", ".join(f"{number} {_COUNTS[what]}" for what, number in sorted(counts.items())), ""))
    if profile.stamp:
        yield text((f"nothing has changed: without --profile, the stamp answers, in {_ms(here['stamp'])} ms", ""))


def to_json(profile: Profile) -> dict[str, Any]:
    """The same as plain data, in milliseconds: docs/json.md."""
    here, counts = profile.results()
    return {
        "ms": round(sum(here.values()) / 1e6, 3),
        "stages": [
            {"stage": name, "ms": round(here.get(name, 0) / 1e6, 3), "elsewhere_ms": round(others / 1e6, 3)}
            for name in (*STAGES, OTHER)
            if (others := profile.elsewhere[name]) or here.get(name)
        ],
        "counts": counts,
        "stamp": profile.stamp,
    }


def _ms(nanoseconds: int) -> str:
    return f"{nanoseconds / 1e6:.1f}"
