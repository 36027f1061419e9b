"""Finds the installed domains by name."""

from __future__ import annotations

import contextlib
import importlib
import os
import re
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import cast

from urdfsync.common.dependencies.program import identity
from urdfsync.common.diagnostics import ConfigError
from urdfsync.common.extras import install_command
from urdfsync.common.spelling import nearest
from urdfsync.domain import Domain, Translator

_OWN = {"table": "urdfsync.formats.table.domain:DOMAIN", "urdf": "urdfsync.formats.urdf.domain:DOMAIN"}
"""Our own domains, which are entry points, too: searching entry points would cost every build 20 ms of imports."""
_TRANSLATORS = {
    "urdf": (
        Translator(
            "mjcf",
            "urdfsync.formats.mjcf.worker",
            {
                "not-installed": install_command("mjcf"),
                "mjcf": "correct it, then build again",
                "mjcf-limits": "use coarser meshes, or a model with fewer bodies",
            },
            # an XML whose root element is <mujoco>, a part of one, or a compiled model
            re.compile(
                rb"(?s)\A(?:(?:\xef\xbb\xbf)?\s*+(?>(?:<\?.*?\?>|<!--.*?-->)\s*+)*+<mujoco(?:include)?\b|1\xd4\0\0)"
            ),
            compares=True,
        ),
        Translator(
            "sdf",
            "urdfsync.formats.sdf.worker",
            {
                "sdf": "correct it, then build again",
                "sdf-limits": "look for models that include many others",
            },
            # an XML whose root element is <sdf>
            re.compile(rb"(?s)\A(?:\xef\xbb\xbf)?\s*+(?>(?:<\?.*?\?>|<!--.*?-->)\s*+)*+<sdf\b"),
            compares=True,
        ),
    ),
}
"""Translators of other formats, by the domain that reads what they write."""
_places: dict[tuple[str, ...], str] = {}
"""Found domains by name and Python's path. A process keeps its loaded code, so these stay valid. A build asks three
times, and each search takes 5 of its 50 ms.
"""


def domain(name: str) -> Domain:
    """Load the domain of this name. Raises ConfigError, without file and line, for a missing or broken domain."""
    place = _place(name)
    if not place:
        near = nearest(name, names())
        hint = f'did you mean "{near}"?' if near else f"use one of {', '.join(names())}"
        raise ConfigError.of("unknown-domain", f"there is no domain `{name}`", hint=hint)
    module, _, attribute = place.partition(":")
    try:
        return cast("Domain", getattr(importlib.import_module(module), attribute))
    except (ImportError, AttributeError) as problem:
        message = f"the domain `{name}` can't be loaded: {problem}"
        raise ConfigError.of("broken-domain", message, hint="install it again") from problem


def top_level(name: str) -> str:
    """Return the top-level package or module of a domain's code; empty if there is no such domain."""
    return _place(name).partition(":")[0].partition(".")[0]


def names() -> list[str]:
    """Return the names of all installed domains, sorted."""
    return sorted(_OWN.keys() | _installed().keys())


def translators(name: str) -> Sequence[Translator]:
    """Return the translators of other formats into the format of a domain."""
    return _TRANSLATORS.get(name, ())


def _place(name: str) -> str:
    if name in _OWN:
        return _OWN[name]
    key = (name, *sys.path)
    if place := _places.get(key) or _installed().get(name, ""):  # a domain may be installed while the daemon runs
        _places[key] = place
    return place


def is_own(name: str) -> bool:
    """Return whether a domain is a part of urdfsync."""
    return name in _OWN


def code(name: str) -> list[str]:
    """Return the folders, or the file, with the code and templates of a domain of somebody else; none of an own one."""
    if is_own(name):
        return []
    templates = domain(name).templates
    module = sys.modules[top_level(name)]
    file = module.__file__ or ""
    is_package = not file or os.path.basename(file) == "__init__.py"  # noqa: PTH119
    folders = [os.path.dirname(file)] if file else module.__path__  # noqa: PTH120
    return [*(folders if is_package else [file]), *([str(templates)] if templates else [])]


def program(name: str) -> str:
    """Return the identity of urdfsync with a domain's code and templates; they are no inputs that builds record."""
    return identity(*code(name))


def _installed() -> dict[str, str]:
    from importlib.metadata import PathDistribution

    domains = dict[str, str]()
    for folder in sys.path:
        names = list[str]()
        with contextlib.suppress(OSError):  # an entry of Python's path may be missing, or an archive
            names = os.listdir(folder or ".")  # noqa: PTH208
        for name in names:
            # strings are three times as fast as paths: there are hundreds of distributions
            file = f"{folder or '.'}/{name}/entry_points.txt"
            if not name.endswith("-info") or not os.path.isfile(file):  # noqa: PTH113
                continue
            with contextlib.suppress(OSError):  # Python ignores such distributions, too
                if b"[urdfsync.domains]" in Path(file).read_bytes():  # parsing all distributions takes 15 ms
                    entries = PathDistribution(Path(file).parent).entry_points.select(group="urdfsync.domains")
                    # the entry's name is the domain's name, its value `module:object`; the first entry on the path
                    # counts
                    domains = {entry.name: entry.value for entry in entries} | domains
    return domains
