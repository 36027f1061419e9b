"""Templates to text: delimiters, strictness, and whose template wins."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import jinja2
import pytest

from urdfsync.render import Renderer


def folder(path: Path, **templates: str) -> Path:
    path.mkdir()
    for name, text in templates.items():
        (path / f"{name}.jinja").write_text(text, encoding="utf-8", newline="\n")
    return path


def rendered(path: Path, text: str, **data: object) -> str:
    return Renderer([folder(path / "templates", t=text)]).render("t.jinja", data)


def test_braces_are_modelica_and_angle_brackets_are_ours(tmp_path: Path) -> None:
    text = "extent={{-10, 90}, {10, 110}} <# not shown #><< x >> {% {# #} %}\n"
    assert rendered(tmp_path, text, x="1") == "extent={{-10, 90}, {10, 110}} 1 {% {# #} %}\n"


def test_the_literals_are_filters(tmp_path: Path) -> None:
    numbers = "<< x | real >> << v | vector >> << [v] | matrix(2) >>"
    texts = "<< s | string >> << s | html >> << s | capitalize_first >>"
    expected = '0.5 {1, 2} [1, 2] "a\\"b" a&quot;b A"b'
    assert rendered(tmp_path, f"{numbers} {texts}", x=0.5, v=(1.0, 2.0), s='a"b') == expected


def test_what_is_not_there_is_an_error_and_not_an_empty_text(tmp_path: Path) -> None:
    with pytest.raises(jinja2.UndefinedError, match="mass"):
        rendered(tmp_path, "<< mass >>")


@pytest.mark.parametrize(
    "text", ["<< 1/0 >>", "<% include 'x' %>", "<# a", "{{ x }}", "#>", ">>", "%>", "-%>\n", "\r\n"]
)
def test_text_from_outside_is_never_a_template(text: str, tmp_path: Path) -> None:
    assert rendered(tmp_path, "[<< x >>]", x=text) == f"[{text}]"


def test_a_template_in_an_earlier_folder_hides_its_namesake(tmp_path: Path) -> None:
    ours = folder(tmp_path / "ours", t="<% include 'part.jinja' %>", part="ours", other="other")
    users = folder(tmp_path / "users", part="theirs")
    renderer = Renderer([users, ours])
    assert renderer.render("t.jinja", {}) == "theirs"
    assert renderer.render("other.jinja", {}) == "other"


def test_an_item_of_a_dict_goes_before_its_methods(tmp_path: Path) -> None:
    assert rendered(tmp_path, "<< d.items >> << d.keys() | list >>", d={"items": 1}) == "1 ['items']"


def test_a_template_has_what_jinja_has_everywhere(tmp_path: Path) -> None:
    assert rendered(tmp_path, "<< range(2) | list >><% set range = 3 %><< range >>") == "[0, 1]3"


def test_once_joins_what_a_macro_makes_of_values(tmp_path: Path) -> None:
    text = "<% import 'parts.jinja' as parts %><< pieces | once(parts.one) >>"
    renderer = Renderer([folder(tmp_path / "own", t=text, parts="<% macro one(part) %><< part.n >>;<% endmacro %>")])
    assert renderer.render("t.jinja", {"pieces": [{"n": 1}, {"n": 2}]}) == "1;2;"


_DOUBLE = "<% set n.a = [n.a, n.a] %><% set n.b = [n.b, n.b] %>"


@pytest.mark.skipif(sys.platform == "win32", reason="no such timer")
@pytest.mark.parametrize(
    "text",
    [
        f"<% set n = namespace(a=[1], b=[1]) %>{60 * _DOUBLE}<< n.a == n.b >>",
        "<< ('a' * 60000000) | map('upper') | map('lower') | select('equalto', 'b') | list >>",
        "<< ('a' * 500000000) | unique | list >>",
    ],
)
def test_a_step_that_cannot_be_interrupted_ends_with_the_process(tmp_path: Path, text: str) -> None:
    """Loops and calls look at the clock; what Jinja and Python do in one step does not."""
    (tmp_path / "endless.jinja").write_text(text)
    program = (
        "import pathlib; from urdfsync import render; render.MAX_SECONDS, render.GRACE = 0.2, 0.2\n"
        "render.Renderer([pathlib.Path()]).render('endless.jinja', {})"
    )
    ended = subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=False, timeout=60)
    assert ended.returncode == -signal.SIGVTALRM


def test_a_text_leaves_no_timer(tmp_path: Path) -> None:
    assert rendered(tmp_path, "<< 1 >>") == "1"
    assert signal.getitimer(signal.ITIMER_VIRTUAL) == (0.0, 0.0)
