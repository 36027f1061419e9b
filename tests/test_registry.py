"""Domains that are installed."""

from __future__ import annotations

from pathlib import Path

from urdfsync import dependencies, registry
from urdfsync.facts import NAMES


def test_domains_that_are_installed_depend_on_what_else_is(rc_domain: None, rc_site: Path) -> None:
    with dependencies.Dependencies() as found:
        registry.domain("rcnetwork")
    assert (NAMES, str(rc_site)) in found.modules
