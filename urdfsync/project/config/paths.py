"""Finds folders: the working folder, ROS packages, and urdfsync's own files."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path

from urdfsync.common.diagnostics import ConfigError
from urdfsync.domain import Domain
from urdfsync.modelica.names import LIBRARY

_ROW = re.compile(r"^\| `[^|]*` \|.*\|$", re.MULTILINE)
_LINK = re.compile(r"\[([^\[\]]*)\]\([^()]*\)")


def working_folder() -> Path:
    """Return the working folder. Raises ConfigError if the folder was deleted."""
    try:
        return Path.cwd()
    except FileNotFoundError:
        message, hint = "the working folder does not exist any more", "change to a folder that exists"
        raise ConfigError.of("no-folder", message, hint=hint) from None


def ros_package_path() -> tuple[Path, ...]:
    """Return the folders of ROS 1 packages, by ROS_PACKAGE_PATH, and of ROS 2 packages, by AMENT_PREFIX_PATH."""
    folders = os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep)
    prefixes = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    paths = [*filter(None, folders), *(f"{prefix}/share" for prefix in prefixes if prefix)]
    return tuple(Path(folder).absolute() for folder in paths)


def library_folder() -> Path:
    """Return the folder to put on MODELICAPATH: it holds the library `UrdfSync`."""
    return _data_folder("modelica")


def find_own_library(name: str, package: str) -> Path | None:
    """Return the folder of UrdfSync if `name` is that library's and `package` is no part of it; else None."""
    return library_folder() / LIBRARY if name == LIBRARY != package.partition(".")[0] else None


def templates_folder(domain: Domain) -> Path:
    """Return the folder of a domain's own templates."""
    return domain.templates or _data_folder("templates") / domain.name


def explained(page: str) -> Iterator[tuple[str, list[str]]]:
    """Yield the names in the first column of a page's tables, each with the other cells of its row.

    SARIF and the schema take their explanations from the pages.
    """
    text = _LINK.sub(r"\1", (_data_folder("docs") / page).read_text(encoding="utf-8"))
    for row in _ROW.findall(text):
        names, *cells = (cell.strip() for cell in row.strip("|").split("|"))
        yield from ((name, cells) for name in re.findall("`([^`]+)`", names))


def _data_folder(name: str) -> Path:
    """Return a folder of a wheel, or of the repository around an editable installation."""
    package = Path(__file__).parents[2]
    installed = package / "_data" / name
    return installed if installed.is_dir() else package.parent / name
