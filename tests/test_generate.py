"""Paths that a package can't have, and what the generated text of a whole package is worth to a compiler."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync import cli
from urdfsync.diagnostics import OutputError
from urdfsync.generate import check_paths


@pytest.mark.parametrize(
    "path",
    [
        "../evil.mo",
        "a/../../evil.mo",
        "/etc/x",
        "",
        "a//b",
        "./a",
        "a/.",
        "a\\b",
        "C:/x",
        "a\nb",
        "a\0b",
        "a.",
        "b /c",
        "a?",
    ],
)
def test_paths_that_leave_the_package_or_are_none_everywhere(path: str) -> None:
    with pytest.raises(OutputError, match="is no path inside the package"):
        check_paths([path])


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
        check_paths(paths)


def test_paths_of_a_usual_package() -> None:
    check_paths(["package.mo", "Links/package.mo", "Links/A.mo", "Links/B.mo", "A.mo", "Resources/ä b.stl"])


def test_a_compiler_reads_the_second_domain(project: Path) -> None:
    """Every file of the RC network's package parses, by a parser that knows nothing of urdfsync."""
    parser = pytest.importorskip("pymoca.parser", reason="pymoca is not installed")
    cli.main(["build", "--quiet"])
    files = sorted((project / "modelica").rglob("*.mo"))
    assert len(files) == 11
    for file in files:
        tree = parser.parse(file.read_text())
        name = file.parent.name if file.name == "package.mo" else file.stem
        assert tree is not None
        assert name in str(tree.to_json(tree)), file
