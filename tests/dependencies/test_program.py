"""The identity of the program follows from the contents of its own files, and from the versions of its packages."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from urdfsync.dependencies import program


@pytest.fixture
def code(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The code of a program that one may change, beside its templates."""
    package = tmp_path / "site/urdfsync"
    (package / "engine").mkdir(parents=True)
    (package / "__init__.py").write_text("first = 1\n")
    (package / "engine/plan.py").write_text("second = 2\n")
    (tmp_path / "site/templates").mkdir()
    (tmp_path / "site/templates/link.mo.jinja").write_text("model\n")
    (tmp_path / "state").mkdir()
    monkeypatch.setattr(program, "_PACKAGE", str(package))
    monkeypatch.setattr(sys, "path", [str(tmp_path / "site")])
    return package


def identity(state: str = "") -> str:
    """The identity as another process would find it."""
    program._identity.clear()
    found = program.identity(state)
    program._identity.clear()
    return found


@pytest.mark.parametrize("state", ["", "state"])
def test_what_appears_beside_the_code_does_not_matter(code: Path, tmp_path: Path, state: str) -> None:
    folder = str(tmp_path / state) if state else ""
    before = identity(folder)
    for name in (
        "__pycache__/plan.pyc",
        ".mypy_cache/plan.py",
        "engine/.plan.py.swp",
        "_data/docs/page.md",
        "notes.txt",
    ):
        (code / name).parent.mkdir(parents=True, exist_ok=True)
        (code / name).touch()
    (code.parent / ".ruff_cache").mkdir()
    (code / "engine/plan.py").touch()
    assert identity(folder) == before


@pytest.mark.parametrize("state", ["", "state"])
def test_each_content_and_each_version_does(
    code: Path, tmp_path: Path, state: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder, found = str(tmp_path / state) if state else "", list[str]()
    monkeypatch.setattr(program, "is_young", lambda facts, now: False)  # else there is no memo
    for step in range(4):
        found += [identity(folder), identity(folder)]
        if step == 0:
            (code / "engine/plan.py").write_text("second = 3\n")
        elif step == 1:
            (code.parent / "templates/link.mo.jinja").write_text("record\n")
        elif step == 2:
            (code.parent / "jinja2-3.2.0.dist-info").mkdir()
    assert found[::2] == found[1::2]
    assert len(set(found)) == 4


def test_a_memo_saves_reading_the_files(code: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(program, "is_young", lambda facts, now: False)
    before = identity(str(tmp_path / "state"))
    monkeypatch.setattr(program, "contents_hash", lambda *_: pytest.fail("the files are read"))
    assert identity(str(tmp_path / "state")) == before
