"""Runs `diff --edits --patch`, whose output may be any bytes."""

from __future__ import annotations

import contextlib
import io

from urdfsync.commands import cli


def patch_and_told(*arguments: str, code: int = 0) -> tuple[bytes, list[str]]:
    """The patch, and the lines of the error stream."""
    content, told = io.BytesIO(), io.StringIO()
    out = io.TextIOWrapper(content, encoding="utf-8")
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(told):
        found = cli.main(["diff", "--edits", "--patch", *arguments])
    out.flush()
    assert found == code, told.getvalue()
    return content.getvalue(), told.getvalue().splitlines()
