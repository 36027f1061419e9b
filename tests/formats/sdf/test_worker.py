"""A process with limits reads a stranger's SDF, and no other process loads its reader."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from support.sdfs import ARM, arm, sdf

from urdfsync.common.diagnostics import SourceError
from urdfsync.domain import Translator
from urdfsync.engine.sources import expansion
from urdfsync.engine.sources.expansion import SourceFiles, expand
from urdfsync.engine.sources.translators import find_translator


def translator(file: Path) -> Translator:
    found = find_translator("urdf", file, file.read_bytes())
    assert found is not None
    return found


def told(folder: Path, content: str, **arguments: str) -> str:
    """Return the only error of a translation."""
    file = folder / "arm.sdf"
    file.write_text(content)
    with pytest.raises(SourceError) as error:
        expand(SourceFiles(folder, file, ()), arguments, translator=translator(file))
    (found,) = error.value.diagnostics
    return str(found)


@pytest.mark.parametrize("name", ["arm.sdf", "arm.world", "arm.urdf", "arm.xml", "arm.xacro"])
@pytest.mark.parametrize("beginning", ["", "\ufeff", "\n\n", "<!-- an arm -->\n<!-- of <robot> -->"])
def test_an_sdf_is_known_by_its_root_element(name: str, beginning: str) -> None:
    text = f"{beginning}{ARM if not beginning else arm()}"
    found = find_translator("urdf", Path(name), text.encode())
    assert found is not None
    assert found.name == "sdf"


@pytest.mark.parametrize(
    "text", ["<robot><gazebo><sdf/></gazebo></robot>", "<!-- <sdf> --><robot/>", "<sdfs/>", "", "sdf"]
)
def test_nothing_else_is(text: str) -> None:
    assert find_translator("urdf", Path("arm.sdf"), text.encode()) is None


def test_a_fault_has_file_line_and_hint(folder: Path) -> None:
    (folder / "hand.sdf").write_text(sdf('<model name="hand">\n<link/></model>'))
    include = "<include><uri>hand.sdf</uri></include>"
    assert (
        told(folder, arm(more=include)) == "hand.sdf:3: error: <link> has no name; correct it, then build again [sdf]"
    )


@pytest.mark.skipif(sys.platform == "win32", reason="it has no such limits")
def test_a_model_that_takes_too_long_is_ended(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(expansion, "CPU_SECONDS", 0.1)
    links = "".join(f'<link name="l{number}"/>' for number in range(15_000))
    assert "expanding it takes more than 0.1 s or 1 GB" in told(folder, arm(more=links))


def test_models_that_are_nested_deep_are_told(folder: Path) -> None:
    models = "".join(f'<model name="m{number}">' for number in range(300)) + "</model>" * 300
    assert "elements are nested 256 deep" in told(folder, arm(more=models))


def test_a_long_chain_of_frames_is_read(folder: Path) -> None:
    frame = '<frame name="f{}" attached_to="{}"><pose>0 0 1 0 0 0</pose></frame>'
    frames = "".join(frame.format(number, f"f{number + 1}") for number in range(1500))
    file = folder / "arm.sdf"
    file.write_text(arm(more=frames + frame.format(1500, "part")))
    made = expand(SourceFiles(folder, file, ()), {}, translator=translator(file))
    assert '<origin xyz="0.0 0.0 1501.0"' in made.text


def test_files_that_include_each_other_too_deep_are_told(folder: Path) -> None:
    for number in range(600):
        include = f"<include><uri>m{number + 1}.sdf</uri></include>"
        (folder / f"m{number}.sdf").write_text(sdf(f'<model name="m"><link name="part"/>{include}</model>'))
    fault = "arm.sdf: error: its parts are nested too deep; correct it, then build again [sdf]"
    assert told(folder, arm(more="<include><uri>m0.sdf</uri></include>")) == fault


def test_a_package_has_a_name_that_is_the_same_on_each_machine(folder: Path) -> None:
    (folder / "models/hand").mkdir(parents=True)
    (folder / "models/hand/model.config").write_text('<model><sdf version="1.9">hand.sdf</sdf></model>')
    (folder / "models/hand/hand.sdf").write_text(sdf('<model name="hand"><link name="palm"/></model>'))
    (folder / "project").mkdir()
    file = folder / "project/arm.sdf"
    file.write_text(arm(more="<include><uri>model://hand</uri></include>"))
    made = expand(SourceFiles(folder / "project", file, (folder / "models",)), {}, translator=translator(file))
    assert list(made.files) == ["arm.sdf", "package://hand/hand.sdf", "package://hand/model.config"]
    assert "hand::palm" in made.text


def test_an_unknown_argument_is_told(folder: Path) -> None:
    file = folder / "arm.sdf"
    file.write_text(ARM)
    made = expand(SourceFiles(folder, file, ()), {"length": "3", "model": "arm"}, translator=translator(file))
    assert made.unused == ("length",)


def test_no_build_of_a_urdf_loads_anything_of_it(folder: Path) -> None:
    (folder / "arm.urdf").write_text('<robot name="arm"><link name="base"/></robot>')
    (folder / "urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    code = "import sys; from urdfsync.commands import cli; cli.main(['build', '--full']); print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], cwd=folder, capture_output=True, text=True, check=True)
    assert "urdfsync.formats.urdf.parse.source" in done.stdout
    assert [
        name
        for name in done.stdout.split()
        if name.startswith(("urdfsync.formats.sdf", "urdfsync.formats.translation"))
    ] == []
