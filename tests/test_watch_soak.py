"""The daemon under random edits, see `watch_soak`: for `$URDFSYNC_SOAK` seconds, three minutes if that is not set."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest
import watch_soak


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="folders that are watched can't be replaced there")
def test_nothing_is_lost_and_nothing_stale(tmp_path: Path) -> None:
    seconds = float(os.environ.get("URDFSYNC_SOAK", "180"))
    soak = watch_soak.run(tmp_path, seconds, seed=1)
    assert soak.problems == []
    assert soak.counts["event built"] >= seconds / 20, soak.counts
    assert soak.counts["comments"] >= seconds / 20, soak.counts
