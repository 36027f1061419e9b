"""MuJoCo reads a stranger's file in a process with limits, and no other process loads it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from support.mjcfs import ARM, body

from urdfsync.common.diagnostics import SourceError
from urdfsync.domain import Translator
from urdfsync.engine.sources import expansion
from urdfsync.engine.sources.expansion import SourceFiles, compare, expand
from urdfsync.engine.sources.translators import find_translator

BROKEN = 'raise ImportError("No module named mujoco")\n'


def translator(file: Path) -> Translator:
    found = find_translator("urdf", file, file.read_bytes())
    assert found is not None
    return found


def told(folder: Path, content: str | bytes, **arguments: str) -> str:
    """Return the only error of a translation."""
    file = folder / "arm.xml"
    file.write_bytes(content.encode() if isinstance(content, str) else content)
    with pytest.raises(SourceError) as error:
        expand(SourceFiles(folder, file, ()), arguments, translator=translator(file))
    (found,) = error.value.diagnostics
    return str(found)


@pytest.mark.parametrize(
    "beginning",
    [
        "",
        "\ufeff",
        "\n\n",
        '<?xml version="1.0"?>\n',
        "<!-- an arm -->\n<!-- of <robot> -->",
        '<?xml version="1.0"?><!---->\n',
    ],
)
def test_an_mjcf_is_known_by_its_root_element(beginning: str) -> None:
    found = find_translator("urdf", Path("arm.xml"), f"{beginning}{ARM}".encode())
    assert found is not None
    assert found.name == "mjcf"


@pytest.mark.parametrize("text", ["<robot><mujoco/></robot>", "<!-- <mujoco> --><robot/>", "<mujocos/>", "", "mujoco"])
def test_nothing_else_is(text: str) -> None:
    assert find_translator("urdf", Path("arm.xml"), text.encode()) is None


@pytest.mark.slow
def test_a_compiled_model_is_told(folder: Path) -> None:
    assert told(folder, b"1\xd4\0\0rest") == (
        "arm.xml: error: this is a compiled model of MuJoCo (MJB); name the XML file of the model [mjcf]"
    )


@pytest.mark.slow
def test_mujocos_own_finding_has_file_and_line(folder: Path) -> None:
    (folder / "leg.xml").write_text('<mujocoinclude>\n<body><joint wheel="3"/></body></mujocoinclude>')
    assert told(folder, body('<joint/><include file="leg.xml"/>')).startswith(
        "leg.xml:2: error: MuJoCo: Schema violation"
    )


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="it has no such limits")
def test_a_model_that_takes_too_long_is_ended(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(expansion, "CPU_SECONDS", 0.2)
    copies = '<replicate count="4000" offset="1 0 0"><body><joint/><geom size="1"/></body></replicate>'
    assert "expanding it takes more than 0.2 s or 1 GB" in told(folder, body(f"<joint/>{copies}"))


@pytest.mark.slow
def test_nothing_is_written_beside_the_source(folder: Path) -> None:
    """MuJoCo alone would write its warnings into the working folder."""
    file = folder / "arm.xml"
    file.write_text(ARM)
    inputs = SourceFiles(folder, file, ())
    made = expand(inputs, {}, translator=translator(file))
    assert compare(inputs, {}, made.text, translator(file)).differences == ()
    assert [path.name for path in folder.iterdir()] == ["arm.xml"]


@pytest.mark.slow
def test_an_unknown_argument_is_told(folder: Path) -> None:
    file = folder / "arm.xml"
    file.write_text(ARM)
    made = expand(SourceFiles(folder, file, ()), {"length": "3", "body": "upper"}, translator=translator(file))
    assert made.unused == ("length",)


def test_without_mujoco_a_build_says_how_to_install_it(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "broken").mkdir()
    (folder / "broken/mujoco.py").write_text(BROKEN)
    monkeypatch.setenv("PYTHONPATH", str(folder / "broken"))
    assert told(folder, ARM) == (
        "arm.xml: error: MuJoCo can't be loaded: No module named mujoco; pip install mujoco [not-installed]"
    )


def test_no_build_of_a_urdf_loads_anything_of_it(folder: Path) -> None:
    (folder / "arm.urdf").write_text('<robot name="arm"><link name="base"/></robot>')
    (folder / "urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    code = "import sys; from urdfsync.commands import cli; cli.main(['build', '--full']); print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], cwd=folder, capture_output=True, text=True, check=True)
    loaded = [name for name in done.stdout.split() if name.partition(".")[0] == "mujoco" or "mjcf" in name]
    assert "urdfsync.formats.urdf.parse.source" in done.stdout
    assert loaded == []
