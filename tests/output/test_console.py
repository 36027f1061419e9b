"""Lines in files and pipes, and on terminals."""

from __future__ import annotations

import io

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
