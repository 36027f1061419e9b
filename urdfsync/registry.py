"""The domains that are installed, by name."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import cast

from urdfsync.dependencies import depend_on
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.domain import Domain
from urdfsync.spelling import nearest

_OWN = {"urdf": "urdfsync.urdf.domain:DOMAIN"}
"""Ours, also an entry point: looking entry points up would cost every build 20 ms of imports."""


def domain(name: str) -> Domain:
    """Load the domain of this name. Raises ConfigError, without file and line, for one that is missing or broken."""
    place = _place(name)
    if not place:
        near = nearest(name, names())
        hint = f'did you mean "{near}"?' if near else f"use one of {', '.join(names())}"
        raise ConfigError(Diagnostic(Severity.ERROR, "unknown-domain", f"there is no domain `{name}`", hint=hint))
    module, _, attribute = place.partition(":")
    try:
        return cast("Domain", getattr(importlib.import_module(module), attribute))
    except (ImportError, AttributeError) as problem:
        message = f"the domain `{name}` can't be loaded: {problem}"
        raise ConfigError(Diagnostic(Severity.ERROR, "broken-domain", message, hint="install it again")) from problem


def top_level(name: str) -> str:
    """Return the top-level package or module that has the code of a domain; empty if there is no such domain."""
    return _place(name).partition(":")[0].partition(".")[0]


def names() -> list[str]:
    """Return the names of all installed domains, sorted."""
    return sorted(_OWN.keys() | _installed().keys())


def _place(name: str) -> str:
    return _OWN.get(name) or _installed().get(name, "")


def _installed() -> dict[str, str]:
    import importlib.metadata

    for folder in map(Path, sys.path):
        depend_on(folder)
        for file in folder.glob("*-info/entry_points.txt"):
            depend_on(file)
    # an entry's name is the domain's, its value `module:object`
    return {entry.name: entry.value for entry in importlib.metadata.entry_points(group="urdfsync.domains")}
