"""Domains that are installed."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from urdfsync.common.dependencies.program import identity
from urdfsync.domain import registry


def test_the_code_of_a_domain_of_somebody_else_is_a_part_of_the_program(rc_domain: None, rc_site: Path) -> None:
    before = registry.program("rcnetwork")
    assert before != identity() == registry.program("urdf")
    assert any(place.endswith("rc_domain.py") for place in registry.code("rcnetwork"))


def test_a_domain_that_was_found_is_not_looked_for_again(rc_domain: None, monkeypatch: pytest.MonkeyPatch) -> None:
    registry.domain("rcnetwork")
    monkeypatch.setattr(os, "listdir", lambda folder: pytest.fail(f"{folder} is listed"))
    registry.domain("rcnetwork")
