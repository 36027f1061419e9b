"""Edits as people make them in generated models, by kind; `edits` has edits of lines, numbers and files."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from random import Random

from support.printer import STYLES, resaved

Edit = Callable[[str, Random], str | None]
"""A text with one more edit; None if the text has no place for this kind."""

MARK = "byHand"
"""The beginning of new names."""

_PART = re.compile(r"\n  (?:replaceable )?[A-Z][\w.]* (\w+)(?:\(|\n| constrainedby)")
_MODIFIER = re.compile(r"(?<=[\n(] )\s*\b(\w+) = ([\w.]+)(?=[,)])")
_EXTENT = re.compile(r"transformation\(extent=\{\{(-?\d+), (-?\d+)\}, \{(-?\d+), (-?\d+)\}\}")
_NOTE = "\n  annotation ("


def add_component(text: str, _: Random) -> str | None:
    """Add a component behind all others, as most people do. A record gets a number, since it can't have a block."""
    is_record = re.search(r"^record ", text, re.MULTILINE) is not None
    added = f"Real {MARK}Source = 3" if is_record else f"Modelica.Blocks.Sources.Constant {MARK}Source(k = 3)"
    new = f'\n  {added}\n    "Added by hand";\n'
    place = next((text.find(word) for word in ("\nequation\n", _NOTE) if word in text), -1)
    return f"{text[:place]}{new}{text[place:]}" if place >= 0 else None


def add_equation(text: str, _: Random) -> str | None:
    """A variable and its equation."""
    if "\nequation\n" not in text:
        return None
    return text.replace("\nequation\n", f"\n  Real {MARK}Time;\n\nequation\n  {MARK}Time = 2*time;\n", 1)


def change_modifier(text: str, random: Random) -> str | None:
    """Another value for a modifier that is no number."""
    places = [one for one in _MODIFIER.finditer(text) if not one[2][0].isdigit()]
    if not places:
        return None
    place = random.choice(places)
    return (
        f"{text[: place.start(2)]}{place[2]} /* by hand */{text[place.end(2) :]}"
        if place[2] == "true"
        else (f"{text[: place.start(2)]}{MARK}.{place[1]}{text[place.end(2) :]}")
    )


def change_type(text: str, random: Random) -> str | None:
    """A part of another class."""
    places = list(re.finditer(r"\n  (?:replaceable )?((?:Links|Joints|UrdfSync\.Visualizers)\.\w+) \w+", text))
    if not places:
        return None
    place = random.choice(places)
    return f"{text[: place.start(1)]}{MARK}.{place[1].rpartition('.')[2]}{text[place.end(1) :]}"


def move_part(text: str, random: Random) -> str | None:
    """A part elsewhere in the diagram."""
    places = list(_EXTENT.finditer(text))
    if not places:
        return None
    place = random.choice(places)
    left, low, right, high = map(int, place.groups())
    moved = f"transformation(extent={{{{{left + 30}, {low - 50}}}, {{{right + 30}, {high - 50}}}}}"
    return text[: place.start()] + moved + text[place.end() :]


def rename_part(text: str, random: Random) -> str | None:
    """Another name for a part, wherever the file uses it."""
    names = [name for name in _PART.findall(text) if re.search(rf"connect\({name}\.", text)]
    if not names:
        return None
    name = random.choice(names)
    return re.sub(rf"(?<![\w.\"]){name}(?=[.,()\s])(?!\")", f"{MARK}_{name}", text)


EDITS: Mapping[str, Edit] = {
    "add a component": add_component,
    "add an equation": add_equation,
    "change a modifier": change_modifier,
    "change a type": change_type,
    "move a part": move_part,
    "rename a part": rename_part,
    "save again in another style": lambda text, _: resaved(text, STYLES["Dymola"]),
}
