"""The page's own scripts, linted as the page has them: one after the other, in one scope."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from urdfsync.analysis.pages.page import FOLLOWER, SCRIPTS

PAGES = Path(__file__).parents[3] / "urdfsync" / "analysis" / "pages"
CONFIG = Path(__file__).parents[2] / "oxlint.json"


def test_scripts_are_linted(tmp_path: Path) -> None:
    scripts = [(PAGES / name).read_text("utf-8") for name in (*SCRIPTS, FOLLOWER)]
    (tmp_path / "page.js").write_text("\n".join(scripts).replace('"use strict";', "//"))
    command = [str(Path(sys.executable).with_name("oxlint")), "-c", str(CONFIG), "page.js"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_every_script_is_one_of_the_page() -> None:
    assert {path.name for path in PAGES.glob("*.js")} == {*SCRIPTS, FOLLOWER}
