"""Finds the installed domains by name."""

from __future__ import annotations

import contextlib
import importlib
import os
import sys
from pathlib import Path
from typing import cast

from urdfsync.answers.dependencies import Dependencies, include, list_folder, read_file
from urdfsync.diagnostics import ConfigError
from urdfsync.domain import Domain
from urdfsync.spelling import nearest

_OWN = {"table": "urdfsync.table.domain:DOMAIN", "urdf": "urdfsync.urdf.domain:DOMAIN"}
"""Our own domains, which are entry points, too: searching entry points would cost every build 20 ms of imports."""
_places: dict[tuple[str, ...], tuple[str, Dependencies]] = {}
"""Found domains by name and Python's path, with the files that were read. A process keeps its loaded code, so these
stay valid. A build asks three times, and each search takes 5 of its 50 ms.
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


def _place(name: str) -> str:
    if name in _OWN:
        return _OWN[name]
    key = (name, *sys.path)
    if key not in _places:
        with Dependencies() as looked:
            place = _installed().get(name, "")
        if not place:  # a domain may be installed while the daemon runs
            return ""
        _places[key] = place, looked
        return place
    place, looked = _places[key]
    include(looked)
    return place


def _installed() -> dict[str, str]:
    from importlib.metadata import PathDistribution

    domains = dict[str, str]()
    with Dependencies(is_program=True):
        for folder in sys.path:
            names = list[str]()
            with contextlib.suppress(OSError):  # an entry of Python's path may be missing, or an archive
                names = list_folder(folder or ".")
            for name in names:
                # strings are three times as fast as paths: there are hundreds of distributions
                file = f"{folder or '.'}/{name}/entry_points.txt"
                if not name.endswith("-info") or not os.path.isfile(file):  # noqa: PTH113
                    continue
                with contextlib.suppress(OSError):  # Python ignores such distributions, too
                    if b"[urdfsync.domains]" in read_file(file):  # parsing all distributions takes 15 ms
                        entries = PathDistribution(Path(file).parent).entry_points.select(group="urdfsync.domains")
                        # the entry's name is the domain's name, its value `module:object`; the first entry on the path
                        # counts
                        domains = {entry.name: entry.value for entry in entries} | domains
    return domains
