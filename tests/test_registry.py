"""Domains that are installed."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync import registry
from urdfsync.answers import dependencies
from urdfsync.answers.facts import NAMES


def test_domains_that_are_installed_depend_on_what_else_is(rc_domain: None, rc_site: Path) -> None:
    with dependencies.Dependencies() as found:
        registry.domain("rcnetwork")
    assert (NAMES, str(rc_site)) in found.modules


def test_a_domain_that_was_found_is_not_looked_for_again(
    rc_domain: None, rc_site: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    registry.domain("rcnetwork")
    monkeypatch.setattr(registry, "list_folder", lambda folder: pytest.fail(f"{folder} is listed"))
    with dependencies.Dependencies() as found:
        registry.domain("rcnetwork")
    assert (NAMES, str(rc_site)) in found.modules
