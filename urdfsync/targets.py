"""What a robot's package and its class may be called in Modelica."""

from __future__ import annotations

from urdfsync import tables
from urdfsync.diagnostics import Diagnostic
from urdfsync.modelica import names


def class_name(package: str, chosen: str) -> str:
    """The class of the robot model: the one that was chosen, or the last part of the package's name."""
    last = package.rpartition(".")[2]
    return chosen or last[:1].upper() + last[1:]


def problems(table: tables.Table, package: str, chosen: str) -> list[Diagnostic]:
    """What is wrong with the keys `package` and `class` of a table; `chosen` is the class, empty if it has none."""
    parts = package.split(".")
    found = []
    for key, name in [*(("package", part) for part in parts), *([("class", chosen)] if chosen else [])]:
        hint = "use letters, digits and `_`, a letter first"
        if not name:
            message = f"`package` must be a full class name, not {package!r}"
        elif name in names.KEYWORDS:
            message, hint = f"`{key}`: `{name}` is a keyword of Modelica", _instead(name)
        elif not names.is_identifier(name):
            message = f"`{key}`: {name!r} is no Modelica identifier"
        else:
            continue
        found.append(table.problem("modelica-name", key, message, hint))
    for index, part in enumerate(parts if not found else []):
        own_library = part == names.LIBRARY and index == 0 and len(parts) > 1  # `parents` looks whether it is there
        if not names.is_package_name(part) and not own_library:
            message = f"`package`: `{part}` can't be a package: Modelica, Windows or urdfsync has a use for the name"
            found.append(table.problem("modelica-name", "package", message, _instead(part)))
    name = class_name(package, chosen)
    if not found and not names.is_class_name(name):
        message = f"`{name}` can't be the class of a robot model"
        hint = "set `class` to a name with a capital first that neither Modelica nor urdfsync has a use for"
        found.append(table.problem("modelica-name", "class" if chosen else "package", message, hint))
    return found


def _instead(name: str) -> str:
    return f"choose another name, for example `{names.class_name(f'{name} robot')}`"
