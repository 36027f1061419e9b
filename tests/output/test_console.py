"""Lines in files and pipes, and on terminals."""

from __future__ import annotations

import io

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console

from urdfsync.output.console import line, write_lines

PARTS = st.lists(st.tuples(st.text(), st.sampled_from(["", "bold red", "dim"])), max_size=4)


@given(PARTS)
def test_a_file_gets_what_rich_would_write(parts: list[tuple[str, str]]) -> None:
    one = line(*parts)
    file, rich = io.StringIO(newline=""), io.StringIO(newline="")
    write_lines([one], file)
    Console(file=rich, force_terminal=False, color_system=None).print(one, soft_wrap=True)
    assert file.getvalue() == rich.getvalue()


def test_a_terminal_gets_looks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.delenv("NO_COLOR", raising=False)
    stream = io.StringIO()
    write_lines([line(("wrong", "bold red"), (": all", ""))], stream)
    assert stream.getvalue() == "\x1b[1;31mwrong\x1b[0m: all\n"
