"""`docs/json.md` is true: its examples are what the commands print, and its tables name every key."""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path
from typing import Any

import pytest

from urdfsync import cli, config
from urdfsync.domain import Role
from urdfsync.plan import Kind
from urdfsync.report import VERSION

PAGE = (Path(__file__).parents[1] / "docs" / "json.md").read_text(encoding="utf-8")
BUILD, CHANGED, MISTAKE, INIT, LIBRARY = (
    json.loads(text) for text in re.findall(r"```json\n(.*?)```", PAGE, re.DOTALL)
)

URDF = """<robot name="arm">
  <link name="base"/>
  <link name="tip">
    <visual><geometry><mesh filename="package://arm/tip.stl"/></geometry></visual>
  </link>
  <joint name="hold" type="fixed"><parent link="base"/><child link="tip"/></joint>
</robot>
"""

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="the examples have paths of POSIX")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.urdf").write_text(URDF)
    return tmp_path


def printed(capsys: pytest.CaptureFixture[str], folder: Path, *arguments: str) -> Any:
    """What a command prints, as if the folder was that of the examples."""
    capsys.readouterr()
    cli.main([*arguments, "--json"])
    streams = capsys.readouterr()
    assert streams.err == ""
    assert streams.out.isascii()
    text = streams.out.replace(str(folder), "/home/me/project")
    return json.loads(text.replace(str(config.library_folder()), "/opt/urdfsync/modelica"))


def matches(example: Any, real: Any) -> bool:
    """Whether two documents are equal, but for items of lists that an example leaves out."""
    if isinstance(example, dict):
        return example.keys() == real.keys() and all(matches(example[key], real[key]) for key in example)
    if isinstance(example, list):
        return bool(example) == bool(real) and all(any(matches(item, other) for other in real) for item in example)
    return bool(example == real)


def keys(document: Any) -> set[str]:
    inside = document.values() if isinstance(document, dict) else document if isinstance(document, list) else ()
    own = set(document) if isinstance(document, dict) else set()
    return own.union(*map(keys, inside))


def test_init(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert matches(INIT, printed(capsys, folder, "init", "arm.urdf"))


def test_build(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cli.main(["init", "arm.urdf"])
    assert matches(BUILD, printed(capsys, folder, "build"))
    moved = '<child link="tip"/><origin xyz="0 0 0.1"/>'
    (folder / "arm.urdf").write_text(URDF.replace('<child link="tip"/>', moved))
    assert matches(CHANGED, printed(capsys, folder, "build"))
    (folder / "urdfsync.toml").write_text("\n[robots.arm]\nsource = 'arm.urdf'\nsorce = 'x'\npackage = 'Arm'\n")
    assert matches(MISTAKE, printed(capsys, folder, "build"))


def test_library(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert matches(LIBRARY, printed(capsys, folder, "library"))


def test_tables_name_every_key_and_no_other() -> None:
    cells = re.findall(r"^\| (`[^|]*) \|", PAGE, re.MULTILINE)
    named = {name for cell in cells for name in re.findall(r"`(\w+)`", cell)}
    assert named == keys([BUILD, CHANGED, MISTAKE, INIT, LIBRARY])


def test_values_that_are_one_of_a_few_are_all_named() -> None:
    assert {f"`{kind}`" for kind in (*Kind, *Role)} <= set(re.findall(r"`[\w-]+`", PAGE))
    assert f"`version` is {VERSION}" in PAGE


@pytest.mark.parametrize("arguments", [[], ["biuld"], ["build", "--svg", "--check"], ["library", "--nothing"]])
def test_bad_usage_is_a_document_as_well(
    folder: Path, capsys: pytest.CaptureFixture[str], arguments: list[str]
) -> None:
    document = printed(capsys, folder, *arguments)
    assert (document["exit"], document["diagnostics"][0]["code"]) == (2, "usage")
    assert document.keys() == MISTAKE.keys()
