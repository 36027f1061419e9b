"""Names in Modelica: identifiers, reserved words, and `within` clauses."""

from __future__ import annotations

import re
from collections.abc import Collection

KEYWORDS = frozenset(
    """
    algorithm and annotation assert block break class connect connector constant constrainedby der discrete each else
    elseif elsewhen encapsulated end enumeration equation expandable extends external false final flow for function if
    import impure in initial inner input loop model not operator or outer output package parameter partial protected
    public pure record redeclare replaceable return stream then true type when while within
    """.split()
)
"""Modelica's reserved words (language specification 3.6, section 2.3.3)."""

LIBRARY = "UrdfSync"
"""The library that is part of urdfsync."""
STANDARD_LIBRARIES = ("Modelica", "ModelicaServices", "Complex")
"""The libraries of the Modelica Standard Library."""

RESERVED_CLASSES = frozenset(
    """
    assertionlevel boolean clock complex connections externalobject integer modelica modelicaservices real resources
    stateselect string urdfsync
    """.split()
)
"""Types and libraries, in lower case: a class of the same name would hide them from generated models."""

FUNCTIONS = frozenset(
    """
    abs acos activeState actualStream array asin atan atan2 backSample cardinality cat ceil change cos cosh cross delay
    diagonal div edge exp fill firstTick floor getInstanceName hold homotopy identity initialState inStream interval
    inverse linspace ln log log10 matrix max min mod ndims noClock noEvent ones outerProduct pre previous product
    promote reinit rem rooted sample scalar semiLinear shiftSample sign sin sinh size skew smooth spatialDistribution
    sqrt subSample sum superSample symmetric tan tanh terminal terminate ticksInState time timeInState transition
    transpose vector zeros
    """.split()
)
"""Functions and operators of the language, and its variable `time`: a package of the same name would hide them."""

DEVICES = frozenset(["con", "prn", "aux", "nul", *(f"{port}{n}" for port in ("com", "lpt") for n in range(10))])
"""Names, in lower case, that Windows reserves, even with a suffix."""

GENERATED_CLASSES = frozenset({"joints", "links", "package"})
"""Names of files and folders beside a robot's model, in lower case."""

_IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]*", re.ASCII)


def any_case(words: Collection[str]) -> str:
    """Return a regular expression for JSON schemas that matches any of these words in lower or upper case."""
    return "|".join("".join(f"[{c}{c.upper()}]" if c.isalpha() else c for c in word) for word in sorted(words))


def is_identifier(name: str) -> bool:
    """Whether `name` can be a class's name without quotes."""
    return _IDENTIFIER.fullmatch(name) is not None and name not in KEYWORDS


def is_class_name(name: str) -> bool:
    """Whether `name` can be the name of a robot's model: it must begin with a capital, unlike components."""
    free = name.lower() not in RESERVED_CLASSES | DEVICES | GENERATED_CLASSES
    return free and is_identifier(name) and name[:1].isupper()


def in_ascii(text: str) -> str:
    """Return a text with ASCII letters for all letters: `Häuser` becomes `Hauser`."""
    if text.isascii():
        return text
    from anyascii import anyascii  # a late import saves most builds 30 ms

    return anyascii(text)


def class_name(text: str) -> str:
    """Make a class name from any text: `my-robot v2` becomes `MyRobotV2`, and `g1_29dof` becomes `G1_29dof`."""
    name = ""
    for word in re.findall(r"[A-Za-z0-9]+", in_ascii(text)):
        mark = "_" if name[-1:].isdigit() and word[0].isdigit() else ""
        name += mark + word[0].upper() + word[1:]
    return name if is_class_name(name) else f"Robot{name}"


def within(package: str) -> str:
    """Return the `within` clause of the class with this full name, for the first line of its file."""
    parent = package.rpartition(".")[0]
    return f"within {parent};" if parent else "within;"
