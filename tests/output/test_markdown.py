"""Comments on merge requests, as they are rendered: quoted text makes no markup, and long tables are folded."""

from __future__ import annotations

import html
import re

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from markdown_it import MarkdownIt

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.output.console import line
from urdfsync.output.markdown import FOLDED, LONGEST, MOST_ROWS, document
from urdfsync.output.sections import Mark, Section, TextTable

RENDER = MarkdownIt("commonmark").enable(["table", "strikethrough"]).render
HOSTILE = "a|`b`<script>alert(1)</script>\n# @octocat #12 __x__ *y* ~~z~~ [l](http://m.n) ![p](q) &amp; $m$ \\|"
FINE = Section("arm", "in step, 15 files", Mark.FINE)


def section(*rows: tuple[str, ...], mark: Mark = Mark.OPEN, robot: str = "arm") -> Section:
    return Section(robot, "1 file to write", mark, tables=[TextTable("Changes", ("Element", "Change"), rows)])


def cells(rendered: str) -> list[str]:
    """The texts of all cells as people see them."""
    return [html.unescape(re.sub("<[^>]*>", "", cell)) for cell in re.findall("(?s)<td>(.*?)</td>", rendered)]


@pytest.mark.slow
@given(st.text(st.characters(exclude_categories=["C", "Z"]) | st.sampled_from(" |`*_#-+=1.)<>[]!&\\~$@:/"), min_size=1))
@example(HOSTILE)
@example("`a|b`")
@example("</td><br>")
def test_quoted_text_shows_as_it_is(text: str) -> None:
    written = document(
        [Section(text, text, Mark.OPEN, points=[line((text, ""))], tables=[TextTable("Changes", ("",), [(text,)])])]
    )
    rendered = RENDER(written)
    assert rendered == written  # no line of it is read as Markdown
    assert cells(rendered) == [re.sub("([@#])", "\\1\u2060", re.sub("`([^`]+)`", r"\1", text.replace("\n", "\\n")))]
    assert set(re.findall("<([a-z0-9]+)", rendered)) <= {*"ul li h3 p table tr th td code".split()}


def test_nobody_is_called_and_no_issue_is_linked() -> None:
    assert "<li>@\u2060octocat #\u206012</li>" in document(
        [Section("arm", "", Mark.OPEN, points=[line(("@octocat #12", ""))])]
    )


def test_names_with_signs_of_tables_stay_in_their_cell() -> None:
    assert cells(RENDER(document([section(("link a|b", HOSTILE))])))[0] == "link a|b"


def test_of_a_short_table_all_is_open_and_a_long_one_is_folded() -> None:
    rows = [(f"link {number}", "added") for number in range(FOLDED + 1)]
    assert "<details>" not in document([section(*rows[:-1])])
    folded = document([section(*rows)])
    assert f"<details><summary>{FOLDED + 1} changes</summary>\n<table>\n<tr><th>Element</th>" in folded
    assert RENDER(folded).count("<tr>") == FOLDED + 2


def test_of_very_many_rows_the_rest_is_counted_and_a_comment_fits_in_a_comment() -> None:
    rows = [(f"link {number}", "x" * 80) for number in range(MOST_ROWS + 5)]
    assert "… and 5 more" in document([section(*rows)])
    whole = document([section(*rows, robot=f"arm{number}") for number in range(20)])
    assert len(whole) < LONGEST + 20 * 200
    assert "<li>! arm19: 1 file to write (the rest is too long for a comment: the command" in whole


def test_what_needs_attention_comes_first_and_what_is_fine_takes_a_line() -> None:
    wrong = section(("link a", "added"), mark=Mark.WRONG, robot="legs")
    text = document([FINE, section(("link a", "added")), wrong])
    assert re.findall("^<(?:h3|li)>(.*): ", text, re.MULTILINE) == ["✗ legs", "! arm", "✓ arm"]


def test_findings_have_their_place_and_the_worst_are_first() -> None:
    note = Diagnostic(Severity.NOTE, "texture", "textures become colours")
    error = Diagnostic(Severity.ERROR, "no-link", "there is no link", "arm.urdf", 3, hint="export it again")
    found = cells(RENDER(document([], [note, error])))
    assert found[:4] == ["✗ error", "arm.urdf:3", "there is no link; export it again", "no-link"]
    assert found[4] == "note"
