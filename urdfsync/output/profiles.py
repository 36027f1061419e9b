"""How it is shown where the time of a command went."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from urdfsync.profiling import OTHER, STAGES, Profile

_LEAST = 50_000
"""Nanoseconds: shorter stages are left out."""


def profile_lines(profile: Profile) -> Iterator[list[tuple[str, str]]]:
    """A table of all stages that took time, what was done, and whether a saved answer would have been enough.

    Each line is pieces of text with their styles.
    """
    here, counts = profile.results()
    total, elsewhere = sum(here.values()), sum(profile.elsewhere.values())
    yield [(f"{'stage':<18}{'ms':>9}{'share':>7}{'  ms in other processes' if elsewhere else ''}", "bold")]
    for name in (*STAGES, OTHER):
        own, others = here.get(name, 0), profile.elsewhere[name]
        if max(own, others) >= _LEAST:
            yield [(f"{name:<18}{own / 1e6:>9.1f}{own / total:>7.0%}", ""), _others(others, elsewhere)]
    yield [(f"{'total':<18}{total / 1e6:>9.1f}{'':>7}", "bold"), _others(elsewhere, elsewhere)]
    if counts:
        yield [(", ".join(f"{number} {what}" for what, number in sorted(counts.items())), "")]
    if profile.has_answer:
        took = f"{here['saved answer'] / 1e6:.1f} ms"
        yield [(f"nothing has changed: without --profile, the saved answer is printed after {took}", "")]


def _others(nanoseconds: int, elsewhere: int) -> tuple[str, str]:
    return (f"{nanoseconds / 1e6:>23.1f}" if elsewhere else "", "")


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
        "stamp": profile.has_answer,
    }
