"""What users install: a wheel with everything in it; tests/test_merge_requests.py installs one and builds a robot."""

from __future__ import annotations

import email
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

REPOSITORY = Path(__file__).parents[1]

pytestmark = pytest.mark.slow


def tracked(*folders: str) -> set[str]:
    listing = subprocess.run(["git", "ls-files", *folders], cwd=REPOSITORY, check=True, capture_output=True, text=True)
    return set(listing.stdout.splitlines())


def test_wheel_and_sdist_are_complete(tmp_path: Path) -> None:
    """One test: the distributions are built once."""
    command: list[str | Path] = [sys.executable, "-m", "build", "--outdir", tmp_path / "dist", REPOSITORY]
    subprocess.run(command, check=True, capture_output=True)
    names = sorted((tmp_path / "dist").iterdir())
    subprocess.run([sys.executable, "-m", "twine", "check", "--strict", *names], check=True)
    (wheel,), (sdist,) = (tmp_path.glob(f"dist/*.{ending}") for ending in ("whl", "tar.gz"))
    assert_wheel_carries_templates_and_library(wheel)
    assert_metadata_say_what_it_is(wheel)
    assert_sdist_carries_all_that_the_tests_need(sdist)


def assert_wheel_carries_templates_and_library(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    assert names >= {f"urdfsync/_data/{name}" for name in tracked("templates", "modelica")}
    assert names >= tracked("urdfsync")
    assert "urdfsync/_data/docs/findings.md" in names
    assert not any(name.startswith(("tests/", "templates/", "modelica/")) for name in names)


def assert_metadata_say_what_it_is(wheel: Path) -> None:
    archive = zipfile.ZipFile(wheel)
    (name,) = (name for name in archive.namelist() if name.endswith("/METADATA"))
    metadata = email.message_from_bytes(archive.read(name))
    assert metadata["Description-Content-Type"] == "text/markdown"
    assert f"Programming Language :: Python :: {metadata['Requires-Python'][2:]}" in metadata.get_all("Classifier", [])


def assert_sdist_carries_all_that_the_tests_need(sdist: Path) -> None:
    with tarfile.open(sdist) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    assert names >= tracked(
        "urdfsync", "templates", "modelica", "tests", "tools", "docs", "urdfsync.toml", "LICENSE", "action.yml"
    )
