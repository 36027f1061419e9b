"""A stranger's templates: the sandbox holds for all parts of a template, and time, memory and size have limits."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import pytest
from support import hostile
from support.networks import configure

from urdfsync.commands import cli
from urdfsync.engine.package import render
from urdfsync.engine.sources import source

Capture = pytest.CaptureFixture[str]

TEMPLATE = "joint/axis.mo.jinja"
SHELL = "cycler.__init__.__globals__.os.popen({command!r}).read()"


@pytest.fixture
def marker(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Make a project with its own templates; return the file that a command in a template would make."""
    hostile.write_project(tmp_path / "project")
    monkeypatch.chdir(tmp_path / "project")
    configure('templates = "templates"\n')
    _template("")
    return tmp_path / "marker"


def _template(text: str, name: str = TEMPLATE) -> None:
    file = Path("templates", name)
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)


def _status(capsys: Capture) -> str:
    """The only error of `urdfsync status`, which is no traceback."""
    assert cli.main(["status"]) == 2
    said = "".join(capsys.readouterr())
    assert "Traceback" not in said
    (error,) = [line for line in said.splitlines() if ": error:" in line]
    assert "[template]" in error
    return error


@pytest.mark.parametrize(
    "attack",
    [
        "<< {shell} >>",
        "<% set x = {shell} %>",
        "<% macro m() %><< {shell} >><% endmacro %><< m() >>",
        "<% import 'part.jinja' as part %><< part.m(1) >>",
        "<% include 'part2.jinja' %>",
        "<< [''] | map(attribute='__class__') | first >>",
        "<< ('' | attr('__class__')).mro() >>",
        "<< ''['__class__'].mro() >>",
        "<< '{{0.__class__.__mro__}}'.format('') >>",
        "<% set parts = [] %><< parts.append(1) >>",
        "<< self.__init__ >>",
        "<< cycler.__init__.__globals__ >>",
    ],
)
def test_the_sandbox_holds_in_all_parts_of_a_template(marker: Path, capsys: Capture, attack: str) -> None:
    shell = SHELL.format(command=f"touch {marker}")
    _template(attack.format(shell=shell))
    _template(f"<% macro m(x) %><< {shell} >><% endmacro %>", "part.jinja")
    _template(f"<< {shell} >>", "part2.jinja")
    assert "templates/" in _status(capsys)
    assert not marker.exists()


@pytest.mark.parametrize(
    ("attack", "words"),
    [
        ("<< range(1000000) >>", "Range too big"),
        ("<% for n in range(1000) %><< 'a' * 1000000 >><% endfor %>", "characters"),
        ("<< lipsum(1000000000) >>", "lipsum"),
        ("<% macro m() %><< m() >><% endmacro %><< m() >>", "without end"),
        ("<% include 'joint/axis.mo.jinja' %>", "without end"),
        ("<# " + "x" * source.MAX_TEMPLATE + " #>", "too large for a template"),
    ],
)
def test_a_template_has_limits(marker: Path, capsys: Capture, attack: str, words: str) -> None:
    _template(attack)
    assert words in _status(capsys)


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere memory has no limit")
@pytest.mark.parametrize(
    "attack",
    [
        "<< ('a' * 10000000000) | length >>",
        "<< '%10000000000d' | format(1) | length >>",
        "<< '{:10000000000}'.format(1) | length >>",
    ],
)
def test_a_template_takes_no_more_memory_than_it_may(marker: Path, capsys: Capture, attack: str) -> None:
    import resource

    before = resource.getrlimit(resource.RLIMIT_AS)
    _template(attack)
    assert "more memory than its limit" in _status(capsys)
    assert resource.getrlimit(resource.RLIMIT_AS) == before


@pytest.mark.slow
@pytest.mark.parametrize(
    "attack",
    [
        "<% for a in range(99999) %><% for b in range(99999) %><% endfor %><% endfor %>",
        "<% macro m(n) %><< m(n - 1) ~ m(n - 1) if n else '' >><% endmacro %><< m(60) >>",
    ],
)
def test_a_template_takes_no_more_time_than_it_may(
    marker: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch, attack: str
) -> None:
    monkeypatch.setattr(render, "MAX_SECONDS", 1.5)
    _template(attack)
    error = _status(capsys)
    assert "it takes more than 1.5 s" in error
    assert f"templates/{TEMPLATE}:1" in error


def test_a_link_out_of_the_template_folder_is_refused(marker: Path, tmp_path: Path, capsys: Capture) -> None:
    secret = tmp_path / "secret" / "revolute.mo.jinja"
    secret.parent.mkdir()
    secret.write_text("secret")
    file = Path("templates", TEMPLATE)
    file.unlink()
    file.symlink_to(secret)
    assert "link leads out of the template folder" in _status(capsys)
    shutil.rmtree("templates/joint")
    Path("templates/joint").symlink_to(secret.parent)
    assert "link leads out of the template folder" in _status(capsys)
    Path("templates/joint").unlink()
    for path in ("../../secret/revolute.mo.jinja", str(secret)):
        _template(f"<% include {path!r} %>")
        assert "there is no template" in _status(capsys)
