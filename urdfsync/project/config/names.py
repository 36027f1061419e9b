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
    is_class_name,
)

ROBOT_PATTERN = rf"^(?!(?:{any_case(DEVICES)})(?:\.|$))(?=.{{1,100}}$)[A-Za-z0-9](?:[A-Za-z0-9_.-]*[A-Za-z0-9_-])?$"
"""Matches a robot's name."""
_RESERVED = any_case(RESERVED_CLASSES | DEVICES)
_PART = rf"(?!(?:{'|'.join(sorted(KEYWORDS | FUNCTIONS))}|{_RESERVED})(?:\.|$))[A-Za-z_][A-Za-z0-9_]*"
PACKAGE_PATTERN = rf"^(?:{LIBRARY}\.)?{_PART}(?:\.{_PART})*$"
"""Matches valid values of `package`."""
_NO_CLASS = rf"(?!(?:{'|'.join(sorted(KEYWORDS))}|{_RESERVED}|{any_case(GENERATED_CLASSES)})$)"
CLASS_PATTERN = rf"^{_NO_CLASS}[A-Z][A-Za-z0-9_]*$"
"""Matches valid values of `class`."""
LAST_PATTERN = rf"(?:^|\.){_NO_CLASS}[A-Za-z][A-Za-z0-9_]*$"
"""Matches a package whose last part names the class."""


def is_robot_name(name: str) -> bool:
    """Whether a robot's name can be a file's name on every system."""
    return re.fullmatch(ROBOT_PATTERN, name, re.ASCII) is not None


def model_class(package: str, chosen: str) -> str:
    """Return the class of the robot model: the chosen one, or the last part of the package's name."""
    last = package.rpartition(".")[2]
    return chosen or last[:1].upper() + last[1:]


def is_package(name: str) -> bool:
    """Whether a package may have this full name: it must not hide names that generated models use."""
    # the same rule as `PACKAGE_PATTERN`, which takes 4 ms to compile
    reserved = {word.lower() for word in RESERVED_CLASSES | DEVICES}
    return all(
        part.isascii() and part.isidentifier() and part not in KEYWORDS | FUNCTIONS and part.lower() not in reserved
        for part in name.removeprefix(f"{LIBRARY}.").split(".")
    )


def find_name_problems(package: str, chosen: str) -> list[tuple[str, str, str]]:
    """Return key, message and hint for each fault of `package` and `class`; `chosen` is the class or empty."""
    problems, name = [], model_class(package, chosen)
    if not is_package(package):
        hint = "use letters, digits and `_`, and no name that Modelica, Windows or urdfsync reserves, as in Plant.Arm"
        problems.append(("package", f"{package!r} can't be a package", hint))
    if not is_class_name(name) and (chosen or not problems):
        hint = "set `class` to a name that begins with a capital and is not reserved by Modelica or urdfsync"
        problems.append(("class" if chosen else "package", f"{name!r} can't be the class of a robot model", hint))
    return problems
