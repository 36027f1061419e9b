"""Names in a configuration: of robots, which become names of files, and of Modelica packages and classes."""

from __future__ import annotations

import re

from urdfsync.modelica.names import (
    DEVICES,
    FUNCTIONS,
    GENERATED_CLASSES,
    KEYWORDS,
    LIBRARY,
    RESERVED_CLASSES,
    any_case,
    class_name,
    is_class_name,
    is_identifier,
)
from urdfsync.modelica.names import is_package_name as may_be_package

ROBOT_PATTERN = rf"^(?!(?:{any_case(DEVICES)})(?:\.|$))(?=.{{1,100}}$)[A-Za-z0-9](?:[A-Za-z0-9_.-]*[A-Za-z0-9_-])?$"
"""Matches a robot's name."""
_RESERVED = any_case(RESERVED_CLASSES | DEVICES)
_PART = rf"(?!(?:{'|'.join(sorted(KEYWORDS | FUNCTIONS))}|{_RESERVED})(?:\.|$))[A-Za-z_][A-Za-z0-9_]*"
PACKAGE_PATTERN = rf"^(?:{LIBRARY}\.)?{_PART}(?:\.{_PART})*$"
"""Matches what `package` may be."""
_NO_CLASS = rf"(?!(?:{'|'.join(sorted(KEYWORDS))}|{_RESERVED}|{any_case(GENERATED_CLASSES)})$)"
CLASS_PATTERN = rf"^{_NO_CLASS}[A-Z][A-Za-z0-9_]*$"
"""Matches what `class` may be."""
LAST_PATTERN = rf"(?:^|\.){_NO_CLASS}[A-Za-z][A-Za-z0-9_]*$"
"""Matches a package whose last part names the class."""


def is_robot_name(name: str) -> bool:
    """Whether a robot's name can be a file's name on every system."""
    return re.fullmatch(ROBOT_PATTERN, name, re.ASCII) is not None


def model_class(package: str, chosen: str) -> str:
    """Return the class of the robot model: the chosen one, or the last part of the package's name."""
    last = package.rpartition(".")[2]
    return chosen or last[:1].upper() + last[1:]


def find_name_problems(package: str, chosen: str) -> list[tuple[str, str, str]]:
    """Return key, message and hint for each fault of `package` and `class`; `chosen` is the class or empty."""
    parts = package.split(".")
    problems = []
    for key, name in [*(("package", part) for part in parts), *([("class", chosen)] if chosen else [])]:
        if name in KEYWORDS:
            problems.append((key, f"`{key}`: `{name}` is a keyword of Modelica", _example(name)))
        elif not is_identifier(name):
            hint = "use letters, digits and `_`, a letter first"
            problems.append((key, f"`{key}`: {name!r} is no Modelica identifier", hint))
    if problems:
        return problems
    for index, part in enumerate(parts):
        in_own_library = part == LIBRARY and index == 0 and len(parts) > 1  # whether it exists is known at the build
        if not may_be_package(part) and not in_own_library:
            message = f"`package`: `{part}` can't be a package: the name is reserved by Modelica, Windows or urdfsync"
            problems.append(("package", message, _example(part)))
    name = model_class(package, chosen)
    if not problems and not is_class_name(name):
        hint = "set `class` to a name that begins with a capital and is not reserved by Modelica or urdfsync"
        problems.append(("class" if chosen else "package", f"`{name}` can't be the class of a robot model", hint))
    return problems


def _example(name: str) -> str:
    return f"choose another name, for example `{class_name(f'{name} robot')}`"
