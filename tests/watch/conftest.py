"""Fixtures: daemons in threads of a test."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from support.daemon import Daemons


@pytest.fixture
def running(project: Path) -> Iterator[list[Daemons]]:
    """Daemons that are stopped after the test."""
    found: list[Daemons] = []
    yield found
    for daemon in found:
        daemon.stop()
