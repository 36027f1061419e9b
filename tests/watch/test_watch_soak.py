"""The daemon under random edits, see `watch_soak`: half a minute; in the long run `$URDFSYNC_SOAK` seconds, or 180."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest
import watch_soak

LONGER = float(os.environ.get("URDFSYNC_SOAK", "180"))


@pytest.mark.slow
@pytest.mark.parametrize("seconds", [30.0, pytest.param(LONGER, marks=pytest.mark.slow, id="longer")])
@pytest.mark.skipif(sys.platform == "win32", reason="folders that are watched can't be replaced there")
def test_nothing_is_lost_and_nothing_stale(tmp_path: Path, seconds: float) -> None:
    soak = watch_soak.run(tmp_path, seconds, seed=1)
    assert soak.problems == []
    assert soak.counts["event built"] >= seconds / 20, soak.counts
    assert soak.counts["comments"] >= seconds / 20, soak.counts
