"""Paths that a package can't have, and what the generated text of a whole package is worth to a compiler."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.networks import configure, failure

from urdfsync.diagnostics import OutputError
from urdfsync.domain import Artifact, Role, Templates
from urdfsync.engine.generate import Package, check_paths


@pytest.mark.parametrize(
    "path", [*"../evil.mo a/../../evil.mo /etc/x /x a//b ./a a/. a\\b C:/x a. a?".split(), "", "a\nb", "a\0b", "b /c"]
)
def test_paths_that_leave_the_package_or_are_none_everywhere(path: str) -> None:
    with pytest.raises(OutputError, match="is no path inside the package"):
        check_paths((path,))


@pytest.mark.parametrize(
    ("paths", "words"),
    [
        (["A.mo", "A.mo"], "`A.mo` and `A.mo`"),
        (["A.mo", "a.mo"], "`A.mo` and `a.mo`"),
        (["Links/A.mo", "links/B.mo"], "`Links` and `links`"),
        (["Links.mo", "Links/package.mo"], "`Links.mo` and `Links/`"),
        (["links.mo", "Links/package.mo"], "`links.mo` and `Links/`"),
    ],
)
def test_paths_that_are_one_where_case_is_folded(paths: list[str], words: str) -> None:
    with pytest.raises(OutputError, match=words):
        check_paths(tuple(paths))


def test_paths_of_a_usual_package() -> None:
    check_paths(("package.mo", "Links/package.mo", "Links/A.mo", "Links/B.mo", "A.mo", "Resources/ä b.stl"))


@pytest.mark.parametrize(("old", "new"), [(1, 2), (0.0, -0.0), (1, 1.0)])
def test_a_text_changes_with_its_data(tmp_path: Path, old: float, new: float) -> None:
    one, two, again = (
        Package([Artifact("A.mo", Role.RECORD, "t", {"number": n}, "part")], Templates((tmp_path,), ""))
        for n in (old, new, old)
    )
    assert two.changed_since(one) == {"A.mo"}
    assert again.changed_since(one) == set()


@pytest.fixture
def own(project: Path) -> Path:
    """An empty folder for templates of the user's."""
    configure('templates = "own"\n')
    (project / "own" / "element").mkdir(parents=True)
    return project / "own"


@pytest.mark.parametrize(
    ("text", "line", "words"),
    [
        ("one\n<< '\\ud800' >>", 0, "surrogates not allowed"),
        ("\n\n<< element.nme >>", 3, "has no attribute 'nme'"),
        ("<< 1 | nofilter >>", 1, "No filter named 'nofilter'; correct"),
        ("<% include 'element/nothing' %>", 1, "there is no template `element/nothing`"),
        ("<% for a in [1] %>" * 25 + "<% endfor %>" * 25, 0, "too many statically nested blocks"),
    ],
)
def test_a_template_of_the_users_is_named_with_line_and_what_to_do(own: Path, text: str, line: int, words: str) -> None:
    (own / "element/model.mo.jinja").write_text(text)
    message = failure()
    place = f"own/element/model.mo.jinja:{line}" if line else "own/element/model.mo.jinja"
    assert message.startswith(f"{place}: error: ")
    assert words in message
    assert message.endswith("; correct the template, or delete it to get that of urdfsync [template]")


def test_a_template_that_is_not_utf8_is_named_even_if_another_includes_it(own: Path) -> None:
    (own / "element/model.mo.jinja").write_text("<% include 'element/part.jinja' %>")
    (own / "element/part.jinja").write_bytes(b"one\nB\xfccher")
    assert failure().startswith("own/element/part.jinja:2: error: the template is not UTF-8; correct")
