"""Marks of tests that go together."""

from __future__ import annotations

import pytest

LONG = [pytest.mark.slow, pytest.mark.long]
"""Of what is left out of the suite, since others show the same for some robots, and runs in CI after it."""
