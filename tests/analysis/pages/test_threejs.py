"""three.js out of the installed trimesh, or a clear word why there is none."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import zipfile
from pathlib import Path

import pytest

from urdfsync.analysis.pages import threejs
from urdfsync.common.diagnostics import UrdfsyncError


def test_it_is_the_library_without_the_viewer() -> None:
    library = threejs.load()
    assert library.title.startswith("three.js r")
    assert "MIT" in library.licence
    assert "GLTFLoader" in library.text
    assert "B64GLTF" not in library.text


@pytest.mark.parametrize("content", [None, "", "<script>var other;</script>"])
def test_another_trimesh_is_refused(content: str | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    archive = tmp_path / "resources/templates/viewer.zip"
    archive.parent.mkdir(parents=True)
    if content is not None:
        with zipfile.ZipFile(archive, "w") as opened:
            opened.writestr("viewer.html.template", content)
    spec = importlib.machinery.ModuleSpec("trimesh", None, is_package=True)
    spec.submodule_search_locations = [str(tmp_path)]
    monkeypatch.setattr(importlib.util, "find_spec", lambda _: spec)
    with pytest.raises(UrdfsyncError, match="trimesh has no three"):
        threejs.load()
