"""The identity of the program follows from its own files, and from the versions of its packages."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from urdfsync.common.dependencies import program


@pytest.fixture
def code(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The code of a program that one may change, beside its templates."""
    package = tmp_path / "site/urdfsync"
    (package / "engine").mkdir(parents=True)
    (package / "__init__.py").write_text("first = 1\n")
    (package / "engine/plan.py").write_text("second = 2\n")
    (tmp_path / "site/templates").mkdir()
    (tmp_path / "site/templates/link.mo.jinja").write_text("model\n")
    monkeypatch.setattr(program, "_PACKAGE", str(package))
    monkeypatch.setattr(sys, "path", [str(tmp_path / "site")])
    return package


def identity() -> str:
    """The identity as another process would find it."""
    program._identities.clear()
    found = program.identity()
    program._identities.clear()
    return found


def test_what_appears_beside_the_code_does_not_matter(code: Path) -> None:
    before = identity()
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
    assert identity() == before


def test_each_file_and_each_version_does(code: Path) -> None:
    found, by_content = [identity()], program.contents_hash()
    (code / "engine/plan.py").write_text("second = 30\n")
    found.append(identity())
    assert program.contents_hash() != by_content
    by_content = program.contents_hash()
    (code.parent / "templates/link.mo.jinja").touch()
    found.append(identity())
    assert program.contents_hash() == by_content
    (code / "engine/plan.py").rename(code / "engine/plans.py")
    found.append(identity())
    (code.parent / "jinja2-3.2.0.dist-info").mkdir()
    found.append(identity())
    assert len(set(found)) == 5
