"""Comments on merge requests, as they are rendered: quoted text makes no markup, and long tables are folded."""

from __future__ import annotations

import html
import re

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from markdown_it import MarkdownIt

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.output.markdown import FOLDED, LONGEST, MOST_ROWS, Mark, Section, Table, comment, escape

RENDER = MarkdownIt("commonmark").enable(["table", "strikethrough"]).render
HOSTILE = "a|`b`<script>alert(1)</script>\n# @octocat #12 __x__ *y* ~~z~~ [l](http://m.n) ![p](q) &amp; $m$ \\|"
FINE = Section("arm", "in step, 15 files", Mark.FINE)


def section(*rows: tuple[str, ...], mark: Mark = Mark.OPEN, robot: str = "arm") -> Section:
    return Section(robot, "1 file to write", mark, tables=[Table("Changes", ("Element", "Change"), rows)])


def text_of(rendered: str) -> str:
    """The text of a page as people see it."""
    return html.unescape(re.sub("<[^>]*>", "", rendered)).replace("\u2060", "").strip()


@pytest.mark.parametrize("place", ["- {}", "### {}", "| a |\n| --- |\n| {} |"])
@given(st.text(st.characters(exclude_categories=["C", "Z"]) | st.sampled_from(" |`*_#-+=1.)<>[]!&\\~$@:/"), min_size=1))
@example(HOSTILE)
@example("1. a")
@example("1)")
@example("- a")
@example("`a|b`")
def test_quoted_text_shows_as_it_is(place: str, text: str) -> None:
    rendered = RENDER(place.format(escape(text)))
    expected = re.sub("`([^`]+)`", r"\1", text.strip().replace("\n", "\\n"))
    assert " ".join(text_of(rendered).removeprefix("a\n").split()) == " ".join(expected.split())
    assert set(re.findall("<([a-z0-9]+)", rendered)) <= {*"ul li h3 p table thead tbody tr th td code".split()}


def test_nobody_is_called_and_no_issue_is_linked() -> None:
    assert escape("@octocat #12") == "&#64;&#8288;octocat &#35;&#8288;12"


def test_names_with_signs_of_tables_stay_in_their_cell() -> None:
    rendered = RENDER(comment([section(("link a|b", HOSTILE))]))
    assert rendered.count("<td>") == 2
    assert "<td>link a|b</td>" in rendered


def test_of_a_short_table_all_is_open_and_a_long_one_is_folded() -> None:
    rows = [(f"link {number}", "added") for number in range(FOLDED + 1)]
    assert "<details>" not in comment([section(*rows[:-1])])
    folded = comment([section(*rows)])
    assert f"<details>\n<summary>{FOLDED + 1} changes</summary>\n\n| Element | Change |" in folded
    assert RENDER(folded).count("<tr>") == FOLDED + 2


def test_of_very_many_rows_the_rest_is_counted_and_a_comment_fits_in_a_comment() -> None:
    rows = [(f"link {number}", "x" * 80) for number in range(MOST_ROWS + 5)]
    assert "… and 5 more" in comment([section(*rows)])
    whole = comment([section(*rows, robot=f"arm{number}") for number in range(20)])
    assert len(whole) < LONGEST + 200
    assert whole.endswith("The rest is too long for a comment; the command without `--format` shows it.\n")


def test_what_needs_attention_comes_first_and_what_is_fine_takes_a_line() -> None:
    wrong = section(("link a", "added"), mark=Mark.WRONG, robot="legs")
    text = comment([FINE, section(("link a", "added")), wrong])
    assert re.findall("^(?:###|-) (.*): ", text, re.MULTILINE) == ["❌ legs", "⚠️ arm", "✅ arm"]


def test_findings_have_their_place_and_the_worst_are_first() -> None:
    note = Diagnostic(Severity.NOTE, "texture", "textures become colours")
    error = Diagnostic(Severity.ERROR, "no-link", "there is no link", "arm.urdf", 3, hint="export it again")
    rendered = RENDER(comment([], [note, error]))
    cells = re.findall("<td>(.*)</td>", rendered)
    assert cells[:4] == ["❌ error", "arm.urdf:3", "there is no link; export it again", "no-link"]
    assert cells[4] == "ℹ️ note"


def test_empty_columns_are_left_out() -> None:
    assert "| Element |\n" in comment([section(("link a", ""))])
