"""New names for what the export has renamed, in texts that use the old ones."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from urdfsync.modelica.lexer import Token, lex


def rename(base: str, mine: str, names: Mapping[str, str]) -> tuple[str, str]:
    """Return both texts with new names; `names` has them by the old ones.

    A name without a dot before it is renamed if it stands so in base, too; one behind a dot if what is before that dot
    is before a renamed name there. So `robot.elbow` follows, and a variable `elbow` of the user's own does not.
    """
    used = [(before, token.text) for before, token in _uses(base) if token.text in names]
    alone, owners = {name for before, name in used if not before}, {before for before, _ in used if before}

    def renamed(text: str) -> str:
        found = [
            token
            for before, token in _uses(text)
            if token.text in names and (before in owners if before else token.text in alone)
        ]
        for token in reversed(found):
            text = f"{text[: token.start]}{names[token.text]}{text[token.start + len(token.text) :]}"
        return text

    return renamed(base), renamed(mine)


def _uses(text: str) -> Iterator[tuple[str, Token]]:
    """Each token, and the one before the dot before it; an empty text if there is no dot."""
    tokens, _ = lex(text)
    for number, token in enumerate(tokens):
        has_dot = number > 1 and tokens[number - 1].text == "."
        yield (tokens[number - 2].text if has_dot else ""), token
