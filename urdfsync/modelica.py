"""The little that the core knows of Modelica: which names are identifiers, and how a package names its parents."""

from __future__ import annotations

import re

KEYWORDS = frozenset(
    """
    algorithm and annotation assert block break class connect connector constant constrainedby der discrete each else
    elseif elsewhen encapsulated end enumeration equation expandable extends external false final flow for function if
    import impure in initial inner input loop model not operator or outer output package parameter partial protected
    public pure record redeclare replaceable return stream then true type when while within
    """.split()
)
"""Modelica's reserved words (language specification 3.6, section 2.3.3)."""

RESERVED_CLASSES = frozenset(
    """
    assertionlevel boolean clock connections externalobject integer links joints modelica modelicaservices real
    resources stateselect string urdfsync
    """.split()
)
"""Classes, folded to lower case, that a class of these names would hide from generated models."""

_IDENTIFIER = re.compile(r"[A-Za-z_][A-Za-z0-9_]*", re.ASCII)


def is_identifier(name: str) -> bool:
    """Whether `name` can be a class's name without quotes."""
    return _IDENTIFIER.fullmatch(name) is not None and name not in KEYWORDS


def is_class_name(name: str) -> bool:
    """Whether `name` can be the name of a robot's model: a capital first, since what begins small is a component."""
    return is_identifier(name) and name[:1].isupper() and name.lower() not in RESERVED_CLASSES


def class_name(text: str, fallback: str = "Robot") -> str:
    """A class name in capitals-first style made from any text: `my-robot v2` becomes `MyRobotV2`."""
    words = re.findall(r"[A-Za-z0-9]+", text)
    name = "".join(word[0].upper() + word[1:] for word in words)
    return name if is_class_name(name) else fallback + name


def within(package: str) -> str:
    """The `within` clause of the class with this full name, for the first line of its file."""
    parent = package.rpartition(".")[0]
    return f"within {parent};" if parent else "within;"
