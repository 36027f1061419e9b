"""Libraries that a package needs, and those that these need in turn."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync.checking.libraries.dependencies import Dependencies
from urdfsync.diagnostics import OutputError


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """Pumps need Tanks, these need Valves and the standard library; nothing needs Pipes."""
    put(tmp_path / "Pumps 1.0" / "package.mo", "package Pumps import Ta = Tanks; end Pumps;")
    put(tmp_path / "Tanks" / "package.mo", "package Tanks end Tanks;")
    put(tmp_path / "Tanks" / "Round.mo", "model Round Valves.Ball b; import Modelica.Electrical.Analog; end Round;")
    put(tmp_path / "Tanks" / "Resources" / "Old.mo", "model Old Pipes.Bend b; end Old;")
    put(tmp_path / "Valves.mo", "package Valves Pumps.Small p; Arm.Arm a; end Valves;  // Pipes.Bend")
    put(tmp_path / "Pipes.mo", "package Pipes end Pipes;")
    put(tmp_path / "Arm" / "package.mo", "package Arm end Arm;")
    put(tmp_path / "UrdfSync" / "package.mo", "package UrdfSync end UrdfSync;")
    return tmp_path


def put(file: Path, text: str) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)


@pytest.mark.parametrize("text", ["Pumps.Small p;", "import Pumps;", "import P = Pumps; P.Small p;"])
def test_libraries_bring_those_that_they_need(text: str, place: Path) -> None:
    found = Dependencies([place]).of("Arm", [text])
    assert found == {"Pumps": place / "Pumps 1.0", "Tanks": place / "Tanks", "Valves": place / "Valves.mo"}


@pytest.mark.parametrize("text", ["// Pumps.Small", 'String s = "Pumps.Small";', "Absent.Thing a;", "UrdfSync.A a;"])
def test_what_is_not_needed_or_not_there_is_left_out(text: str, place: Path) -> None:
    assert Dependencies([place]).of("Arm", [text]) == {}


def test_a_domain_may_want_one(place: Path) -> None:
    assert Dependencies([place]).of("Arm", [], ["Pipes", "Modelica"]) == {"Pipes": place / "Pipes.mo"}


def test_what_they_need_of_the_standard_library_is_known(place: Path) -> None:
    dependencies = Dependencies([place])
    assert dependencies.standard(dependencies.of("Arm", ["import Tanks;"]).values()) == {"Modelica.Electrical.Analog"}


def test_one_that_can_not_be_read_is_a_clear_error(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(path: Path) -> bytes:
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr(Path, "read_bytes", refuse)
    with pytest.raises(OutputError, match=r"Pipes\.mo: error: it can't be read: Permission denied"):
        Dependencies([place]).of("Arm", ["import Pipes;"])
