"""Changes of the RC network in the working folder, see the fixture `project`."""

from __future__ import annotations

from pathlib import Path


def edit(path: str | Path, old: str, new: str) -> None:
    """Replace a text that a file has once."""
    text = Path(path).read_text()
    assert text.count(old) == 1
    Path(path).write_text(text.replace(old, new))


def resistor(ohm: float, before: float = 100) -> None:
    """Change the source: the resistance of R1."""
    edit("ladder.json", f'"ohm": {before:g}}}', f'"ohm": {ohm:g}}}')
