"""Removes shapes from packages, and turns warnings into variables, so that one simulation tells the time of each.

A compiler may print no warnings, or check them only at the beginning. Shapes change no motion, but a quarter of the
equations of an arm with meshes. Without shapes, rumoca takes a sixth less time.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

_INSIDE = r"(?:[^;\n]|\n(?!  assert\())"
_ASSERTION = re.compile(
    rf"^  assert\((?P<condition>(?:(?!,\s+getInstanceName\(\)){_INSIDE})*+),\s+"
    rf"(?P<message>getInstanceName\(\){_INSIDE}*?), AssertionLevel\.warning\);",
    re.MULTILINE,
)
"""An assertion that only warns, in the layout of generated files; it must not be inside of another equation."""
_SHAPE = re.compile(
    r"^  UrdfSync\.Visualizers\.\w+ \w+\(\n    parameters = [\w.]+,\n    animation = \w+\)(?=\s)", re.MULTILINE
)
"""A shape of a link, in the layout of generated files."""
_EQUATIONS = re.compile(r"^equation$", re.MULTILINE)
_OTHERS = re.compile(r"^(algorithm|initial equation|initial algorithm)$", re.MULTILINE)


def with_flags(texts: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the files of a package without shapes, and with a variable in place of each assertion that only warns."""
    return {
        path: flagged(content.decode("utf-8", "surrogateescape")).encode("utf-8", "surrogateescape")
        if path.endswith(".mo")
        else content
        for path, content in texts.items()
    }


def flagged(text: str) -> str:
    """Return the text of a class with variables in place of warnings: 1 while the warning applies, else 0.

    A variable's name is `warning_` and the words of the message. A class with algorithms keeps its warnings. Shapes get
    a condition that is false.
    """
    text = _SHAPE.sub(r"\g<0> if false", text)
    names = dict[str, None]()

    def flag(match: re.Match[str]) -> str:
        name = "warning_" + re.sub(r"\W+", "_", match["message"]).strip("_")
        if name in names:
            return match[0]
        names[name] = None
        return f"  {name} = noEvent(if {match['condition']} then 0 else 1);"

    changed = _ASSERTION.sub(flag, text)
    declared = "".join(f"Real {name};\n" for name in names)
    return _EQUATIONS.sub(f"{declared}equation", changed, count=1) if names and not _OTHERS.search(text) else text
