"""Writes all golden files anew: `python -m tests --renew`."""

from __future__ import annotations

from support import kept
from support.corpus import REPOSITORY
from support.golden import expected, of_variants, on_disk, pieces
from support.marks import lines_shown


def renew() -> None:
    """Write the golden files; a line of a template that none of them shows gets the first text that shows it."""
    shown, content, former = lines_shown(pieces()), expected(), on_disk()
    for piece in of_variants():
        if more := lines_shown([piece]) - shown:
            shown |= more
            content[piece.file] = piece.content()
    for file in sorted(former.keys() | content.keys()):
        if file not in content:
            file.unlink()
        elif content[file] != former.get(file):
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content[file])
        else:
            continue
        print(file.relative_to(REPOSITORY))  # noqa: T201
    kept.renew(lambda place: print(place.relative_to(REPOSITORY)))  # noqa: T201


if __name__ == "__main__":
    renew()
