"""No command shows findings that a configuration ignores; all codes that can be ignored are known and documented."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from support import checks
from support.commands import Execute
from support.networks import configure, edit

from urdfsync.common.diagnostics import IGNORABLE
from urdfsync.formats.urdf.domain import WARNINGS

REPOSITORY = Path(__file__).parents[1]
UNRELATED = {
    "changed-meanwhile",
    "no-merge",
    "no-merge-driver",
    "conflict",
    "edit-left",
    "exec",
    "identify",
    "no-browser",
    "no-attribute",
    "no-conflict",
    "old-page",
    "not-watched",
    "unmerged",
}
"""Codes of warnings about commands, not about a configuration."""
WORDS = "no node is called `ground`"


@pytest.fixture
def noted(project: Path) -> Path:
    """A network with a note, and a search path that does not exist."""
    edit("ladder.json", '"ground"', '"earth"')
    configure('package_paths = ["nowhere"]\n')
    return project


@pytest.mark.parametrize("command", ["build", "status --verbose", "diff", "build --check", "build --format=json"])
def test_no_command_tells_what_is_ignored(noted: Path, execute: Execute, command: str) -> None:
    told = execute(*command.split(), code=None).words
    assert WORDS in told
    configure('ignore = ["no-ground", "no-package-path"]\n')
    told = execute(*command.split(), code=None).words
    assert WORDS not in told
    assert "nowhere" not in told


@pytest.mark.slow
def test_check_does_not_either(project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("urdfsync.common.processes.workers.workers", checks.thread_workers)
    execute("build", "-q")
    edit("modelica/Ladder/package.order", "Ladder\n", "")
    edit("modelica/Ladder/Elements/R1.mo", "end R1;", "")  # an error keeps the check from compiling
    assert "[order-lacks]" in execute("check", code=None).err
    configure('ignore = ["order-lacks"]\n')
    assert "[order-lacks]" not in execute("check", code=None).words


def test_a_saved_answer_does_not_outlive_the_list(noted: Path, execute: Execute) -> None:
    assert WORDS in execute("build").err
    assert "still 1 finding (" in execute("build").err
    configure('ignore = ["no-ground"]\n')
    assert WORDS not in execute("build").err
    assert WORDS not in execute("build").err
    edit("urdfsync.toml", 'ignore = ["no-ground"]', "ignore = []")
    assert WORDS in execute("build").err


def test_of_all_robots_or_of_one(noted: Path, execute: Execute) -> None:
    table = (noted / "urdfsync.toml").read_text()
    other = table.replace("[robots.ladder]", "[robots.other]").replace('"Ladder"', '"Other"')
    defaults = '[defaults]\nignore = ["no-ground"]\n'
    for ignored, count in ((defaults, 0), ("", 1)):
        (noted / "urdfsync.toml").write_text(f'{ignored}{table}\n{other}ignore = ["no-ground"]\n')
        assert execute("build").err.count(WORDS) == count


def test_errors_are_told(noted: Path, execute: Execute) -> None:
    configure('ignore = ["no-ground"]\nprefix = "in"\n')
    assert "[prefix-is-node]" in execute("build", code=2).err


def test_every_warning_can_be_ignored() -> None:
    files = sorted((REPOSITORY / "urdfsync").rglob("*.py"))
    texts = [path.read_text(encoding="utf-8") for path in files]
    codes = {code for text in texts for code in re.findall(r'(?:WARNING|NOTE),\s*"([\w-]+)"', text)}
    assert codes - UNRELATED - WARNINGS <= IGNORABLE
    assert not IGNORABLE & WARNINGS


def test_every_code_on_the_page_exists() -> None:
    page = (REPOSITORY / "docs/findings.md").read_text(encoding="utf-8")
    places = re.findall(r"^\|[^|]*\|", page, re.MULTILINE)
    source = "".join(path.read_text(encoding="utf-8") for path in (REPOSITORY / "urdfsync").rglob("*.py"))
    assert len(places) > 50
    codes = set(re.findall(r"`([\w-]+)`", "".join(places)))
    assert {code for code in codes if f'"{code}"' not in source} == set()
