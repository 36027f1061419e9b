"""Paths that a package can't have, and what the generated text of a whole package is worth to a compiler."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest
from support.commands import Execute
from support.networks import RC_FOLDER, configure, edit, failure, own_model, run
from support.replay import contents

from urdfsync.common.diagnostics import OutputError
from urdfsync.common.files import Templates
from urdfsync.domain import Artifact, Domain, Order, Role, Target, Version
from urdfsync.engine.package.generate import Package, check_paths, generate


@pytest.mark.parametrize(
    "path", [*"../evil.mo a/../../evil.mo /etc/x /x a//b ./a a/. a\\b C:/x a. a?".split(), "", "a\nb", "a\0b", "b /c"]
)
def test_paths_that_leave_the_package_or_are_none_everywhere(path: str) -> None:
    with pytest.raises(OutputError, match=r"is not a path inside the package.*\[outside\]"):
        check_paths((path,))


@pytest.mark.parametrize(
    ("paths", "words"),
    [
        (["A.mo", "A.mo"], "`A.mo` and `A.mo`"),
        (["A.mo", "a.mo"], "`A.mo` and `a.mo`"),
        (["Links/A.mo", "links/B.mo"], "`Links` and `links`"),
        (["Links/Left/A.mo", "links/Right/B.mo"], "`Links` and `links`"),
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
        Package([Artifact("A.mo", Role.RECORD, "t", {"number": n}, "part")], Templates((tmp_path,), ""), "")
        for n in (old, new, old)
    )
    assert two.changed_since(one) == {"A.mo"}
    assert again.changed_since(one) == set()


class OneFile(Domain):
    """A domain with one file, which counts how often it is asked for it."""

    count = 0

    def artifacts(self, snapshot: Any, *_: Any) -> list[Artifact | Order]:
        self.count += 1
        return [Artifact("A.mo", Role.RECORD, "t", snapshot, "part")]


def test_artifacts_are_made_once_of_the_same_numbers(tmp_path: Path) -> None:
    domain = OneFile()  # type: ignore[abstract]
    for number in (0.0, 0.0, -0.0, 0, 1, 0.0):
        snapshot = {"number": number}
        package = generate(domain, Version(snapshot), Target("P", "M"), None, Templates((tmp_path,), ""))
        assert repr(package.artifacts["A.mo"].data) == repr(snapshot)
    assert domain.count == 4


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
    assert message.endswith("; correct the template, or delete it to use urdfsync's template [template]")


def test_a_template_that_is_not_utf8_is_named_even_if_another_includes_it(own: Path) -> None:
    (own / "element/model.mo.jinja").write_text("<% include 'element/part.jinja' %>")
    (own / "element/part.jinja").write_bytes(b"one\nB\xfccher")
    assert failure().startswith("own/element/part.jinja:2: error: the template is not UTF-8; correct")


MODEL = "own/element/model.mo.jinja"


@pytest.fixture
def copied(own: Path) -> None:
    """A copy of the template of all elements' models as the user's."""
    shutil.copy(RC_FOLDER / "templates/element/model.mo.jinja", MODEL)


@pytest.mark.parametrize(
    ("old", "new", "line", "words"),
    [
        ("OnePort;", "OnePort", 5, "lacks `;` before `parameter`"),
        ("parameters.C*der(v);", "parameters.C*der(v;", 11, "lacks `,` or `)` before `;`"),
        ("end << element.name >>;", "end Other;", 13, "ends `C1` with `end Other`"),
        ("end << element.name >>;\n", "", 12, "lacks `end C1` before its end"),
        ("model << element.name >>", "model Other", 13, "ends `Other` with `end C1`"),
        ("<< element.name >>", "Other", 2, "the class is called `Other`, but its file `C1`"),
        (".Elements;", ";", 1, "the file says `within Ladder;`, but stands in `Ladder.Elements`"),
        ("within << package >>.Elements;\n", "", 1, "the file lacks `within Ladder.Elements;`"),
        ("end << element.name >>;", "end << element.name >>;\nmodel B\nend B;", 14, "the file holds `B` besides `C1`"),
        ("equation\n", "equation\n<% if 1 %>\n  Real;\n<% endif %>\n", 9, "lacks"),
        ("equation\n", "  Real i;\n  Real i;\nequation\n", 8, "declares `i` twice"),
    ],
)
@pytest.mark.usefixtures("copied")
def test_a_text_that_is_no_modelica_is_an_error_at_the_line_of_the_template(
    old: str, new: str, line: int, words: str
) -> None:
    edit(MODEL, old, new)
    before = contents(Path())
    message = failure()
    assert message.startswith(f"{MODEL}:{line}: error: the text for `Elements/C1.mo` is wrong: ")
    assert words in message
    assert message.endswith("; correct the template, or delete it to use urdfsync's template [template]")
    assert contents(Path()) == before


@pytest.mark.parametrize(
    ("use", "piece", "line"),
    [
        ("<% include 'piece.jinja' %>", "\n  Real a\n  Real b;\n", 3),
        ("<% import 'piece.jinja' as p %><< p.x() >>", "\n<% macro x() %>\n  a b c;<% endmacro %>", 3),
        (
            "<% import 'piece.jinja' as p %><% set b %><< p.x() >><% endset %><< b >>",
            "<% macro x() %>1;<% endmacro %>",
            1,
        ),
    ],
)
@pytest.mark.usefixtures("copied")
def test_the_file_that_a_wrong_line_comes_from_is_named(use: str, piece: str, line: int) -> None:
    edit(MODEL, "equation\n", f"{use}\nequation\n")
    Path("own/piece.jinja").write_text(piece)
    assert failure().startswith(f"own/piece.jinja:{line}: error: the text for `Elements/C1.mo` is wrong")


@pytest.mark.usefixtures("copied")
def test_without_a_line_the_template_is_named() -> None:
    """Where a template looks at its own text, that has other lines when each is marked."""
    edit(MODEL, "equation\n", "<% set t %>x<% endset %>Real << t | length >>;\nequation\n")
    assert failure().startswith(f"{MODEL}: error: the text for `Elements/C1.mo` is wrong")


@pytest.mark.parametrize("command", ["build", "build --check", "build --dry-run", "build --full", "status", "diff"])
def test_all_commands_say_what_is_wrong_with_a_template(project: Path, execute: Execute, command: str) -> None:
    run()
    own_model("  Real x")
    before = contents(project)
    said = execute(*command.split(), code=2)
    (error,) = [line for line in (*said.lines, *said.errors) if ": error: " in line]
    assert error.startswith(f"{MODEL}:8: error: the text for `Elements/C1.mo` is wrong: the file lacks `;` before")
    assert contents(project) == before
