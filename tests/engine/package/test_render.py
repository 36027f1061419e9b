"""Templates to text: delimiters, strictness, and whose template wins."""

from __future__ import annotations

import importlib.util
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import jinja2
import pytest

from urdfsync.engine.package import render
from urdfsync.engine.package.render import Renderer


def rendered(path: Path, text: str, **data: object) -> str:
    (path / "t.jinja").write_text(text, encoding="utf-8", newline="\n")
    return Renderer([path, path / "installed"]).render("t.jinja", data)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("extent={{-10, 90}} <# not shown #><< x >> {% {# #} %}\n", "extent={{-10, 90}} 0.5 {% {# #} %}\n"),
        ("<< x | real >> << v | vector >> << [v] | matrix(2) >>", "0.5 {1, 2} [1, 2]"),
        ("<< s | string >> << s | html >> << s | capitalize_first >>", '"a\\"b" a&quot;b A"b'),
        ("<% for one in range(5000) %><< nothing >><% endfor %>end", "end"),
        ("<< d.items >> << d.keys() | list >> << range(2) | list >>", "1 ['items'] [0, 1]"),
    ],
)
def test_a_text_is_rendered(tmp_path: Path, text: str, expected: str) -> None:
    """Angle brackets are ours, braces Modelica's; the documented filters; items go before methods."""
    assert rendered(tmp_path, text, x=0.5, v=(1.0, 2.0), s='a"b', d={"items": 1}, nothing="") == expected


def test_what_is_not_there_is_an_error_and_not_an_empty_text(tmp_path: Path) -> None:
    with pytest.raises(jinja2.UndefinedError, match="mass"):
        rendered(tmp_path, "<< mass >>")


@pytest.mark.parametrize(
    "text", ["<< 1/0 >>", "<% include 'x' %>", "<# a", "{{ x }}", "#>", ">>", "%>", "-%>\n", "\r\n"]
)
def test_text_from_outside_is_never_a_template(text: str, tmp_path: Path) -> None:
    assert rendered(tmp_path, "[<< x >>]", x=text) == f"[{text}]"


_DOUBLE = "<% set n.a = [n.a, n.a] %><% set n.b = [n.b, n.b] %>"


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="no such timer")
@pytest.mark.parametrize(
    "text",
    [
        f"<% set n = namespace(a=[1], b=[1]) %>{60 * _DOUBLE}<< n.a == n.b >>",
        "<< 7 ** (7 ** 11) >>",
        "<< ('a' * 60000000) | map('upper') | map('lower') | select('equalto', 'b') | list >>",
    ],
)
def test_a_step_that_cannot_be_interrupted_ends_with_the_process(tmp_path: Path, text: str) -> None:
    """Loops and calls look at the clock; what Jinja and Python do in one step does not."""
    (tmp_path / "endless.jinja").write_text(text)
    program = (
        "import pathlib; from urdfsync.engine.package import render; render.MAX_SECONDS, render.GRACE = 1.0, 0.2\n"
        "render.Renderer([pathlib.Path(), pathlib.Path('none')]).render('endless.jinja', {})"
    )
    ended = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=False, timeout=60)
    assert ended.returncode == -signal.SIGVTALRM


def test_a_text_leaves_no_timer(tmp_path: Path) -> None:
    assert rendered(tmp_path, "<< 1 >>") == "1"
    assert signal.getitimer(signal.ITIMER_VIRTUAL) == (0.0, 0.0)


@pytest.fixture
def compiled(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of this test for compiled code, where no template is yet."""
    monkeypatch.setattr(sys, "pycache_prefix", str(tmp_path / "compiled"))
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    folder = Path(importlib.util.cache_from_source(render.__file__)).parent
    folder.mkdir(parents=True)
    return folder


def rendered_as_shipped(folder: Path) -> str:
    return Renderer([folder]).render("t.jinja", {"x": 1})


def test_a_template_of_an_installed_package_is_compiled_once_for_each_of_its_texts(
    tmp_path: Path, compiled: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for text in ("a << x >>", "b << x >>"):
        (tmp_path / "t.jinja").write_text(text)
        first = rendered_as_shipped(tmp_path)
        assert first == text.replace("<< x >>", "1")
        with monkeypatch.context() as without_compiler:
            without_compiler.setattr(jinja2.Environment, "compile", None)
            assert rendered_as_shipped(tmp_path) == first
    assert len(list(compiled.iterdir())) == 1, "the new one takes the place of the old one"


@pytest.mark.parametrize(
    "damage",
    [
        lambda whole: b"",
        lambda whole: whole[:20],
        lambda whole: whole[:-1],
        lambda whole: bytes(len(whole)),
    ],
)
def test_damaged_code_of_a_template_is_made_again(
    tmp_path: Path, compiled: Path, damage: Callable[[bytes], bytes]
) -> None:
    (tmp_path / "t.jinja").write_text("right")
    rendered_as_shipped(tmp_path)
    (file,) = compiled.iterdir()
    whole = file.read_bytes()
    file.write_bytes(damage(whole))
    assert rendered_as_shipped(tmp_path) == "right"
    assert file.read_bytes() == whole


def test_an_installed_template_is_compiled_once_beside_a_users_own_template(tmp_path: Path, compiled: Path) -> None:
    installed = tmp_path / "installed"
    installed.mkdir()
    (installed / "part.jinja").write_text("part << x >>")
    (installed / "t.jinja").write_text("<% include 'part.jinja' %>")
    (tmp_path / "part.jinja").write_text("mine << x >>")
    assert [Renderer([tmp_path, installed]).render("t.jinja", {"x": 1}) for _ in range(2)] == ["mine 1"] * 2
    assert len(list(compiled.iterdir())) == 1, "the included one is the user's"


def test_code_of_a_template_is_not_kept_for_strangers_templates_nor_where_python_keeps_none(
    tmp_path: Path, compiled: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rendered(tmp_path, "a")
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    rendered_as_shipped(tmp_path)
    assert not list(compiled.iterdir())
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    compiled.rmdir()
    assert rendered_as_shipped(tmp_path) == "a"
