"""The page on domains of one's own: its code is a domain that works with all commands."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from support.commands import Execute
from support.corpus import REPOSITORY
from support.daemon import Daemons
from support.networks import edit

from urdfsync.commands import cli
from urdfsync.domain import registry
from urdfsync.engine.result import Exit
from urdfsync.watch import events

PAGE = REPOSITORY / "docs" / "domains.md"


def blocks(language: str) -> list[str]:
    """The code blocks of the page in a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE.read_text("utf-8"), re.DOTALL | re.MULTILINE)


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A project with the list of the page; the domain of the page is installed."""
    site, folder = tmp_path / "site", tmp_path / "project"
    for place in (site / "templates", site / "parts_domain-1.dist-info", folder):
        place.mkdir(parents=True)
    (site / "parts_domain.py").write_text(blocks("python")[0])
    for text in blocks("jinja"):
        name, template = text.split("\n", 1)
        (site / name.removeprefix("<# ").removesuffix(" #>")).write_text(template)
    (site / "parts_domain-1.dist-info/METADATA").write_text("Metadata-Version: 2.1\nName: parts-domain\nVersion: 1\n")
    (site / "parts_domain-1.dist-info/entry_points.txt").write_text("[urdfsync.domains]\nparts = parts_domain:DOMAIN\n")
    (folder / "parts.yaml").write_text(blocks("yaml")[0])
    (folder / "urdfsync.toml").write_text(next(text for text in blocks("toml") if "[robots" in text))
    monkeypatch.syspath_prepend(site)
    monkeypatch.chdir(folder)
    yield folder
    sys.modules.pop("parts_domain", None)


def test_the_domain_has_at_most_a_hundred_lines() -> None:
    (code,) = blocks("python")
    assert code.count("\n") <= 100


def test_another_number_renews_one_record(project: Path, execute: Execute) -> None:
    assert cli.main(["build"]) == Exit.IN_STEP
    assert registry.domain("parts").name == "parts"
    assert sorted(path.name for path in (project / "modelica/Gearbox").iterdir()) == [
        *("Gearbox.mo", "Motor.mo", "MotorParameters.mo", "Wheel.mo", "WheelParameters.mo"),
        *("package.mo", "package.order"),
    ]
    edit(project / "parts.yaml", "1.2", "1.4")
    assert "1.2 → 1.4" in execute("diff", code=Exit.OUT_OF_STEP).out
    model = (project / "modelica/Gearbox/Motor.mo").stat()
    assert cli.main(["build"]) == Exit.IN_STEP
    assert "mass = 1.4" in (project / "modelica/Gearbox/MotorParameters.mo").read_text()
    assert (project / "modelica/Gearbox/Motor.mo").stat() == model


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [("1.2,", "1.2, : [", "parts.yaml:4"), ("mass: 1.2", "mass: heavy", "Expected `float`"), ("motor:", "1:", "part")],
)
def test_a_bad_list_is_a_diagnostic(project: Path, execute: Execute, old: str, new: str, words: str) -> None:
    edit(project / "parts.yaml", old, new)
    assert words in execute("build", code=Exit.ERROR).err


def test_the_daemon_watches_it(project: Path) -> None:
    daemon = Daemons()
    try:
        daemon.wait(events.Built)
        daemon.after(lambda: edit(project / "parts.yaml", "1.2", "1.4"), events.Built)
    finally:
        daemon.stop()
    assert "mass = 1.4" in (project / "modelica/Gearbox/MotorParameters.mo").read_text()
