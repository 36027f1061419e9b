"""The copy of the needed part of the standard library."""

from __future__ import annotations

import os
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from urdfsync.checking import library, references, slim
from urdfsync.checking.cache import Cache, CacheError
from urdfsync.checking.library import StandardLibrary
from urdfsync.checking.slim import copy, covers

FILES = {
    "Modelica 4.1.0/package.mo": 'package Modelica annotation(version = "4.1.0"); end Modelica;',
    "Modelica 4.1.0/package.order": "UsersGuide\nBlocks\nMechanics\nFluid\nThermal\nUnits\nInside\n",
    "Modelica 4.1.0/Units.mo": "within Modelica; package Units end Units;",
    "Modelica 4.1.0/Blocks/package.mo": "within Modelica; package Blocks\n  package Examples\n    Fluid.Tank tank;\n"
    "  end Examples;\nend Blocks;",
    "Modelica 4.1.0/Mechanics/package.mo": "within Modelica; package Mechanics end Mechanics;",
    "Modelica 4.1.0/Mechanics/MultiBody/package.mo": "within Modelica.Mechanics; package MultiBody end MultiBody;",
    "Modelica 4.1.0/Mechanics/MultiBody/package.order": "Examples\nBody\nlocal\n",
    "Modelica 4.1.0/Mechanics/MultiBody/Body.mo": "model Body Modelica.Thermal.Port p; end Body;",
    "Modelica 4.1.0/Mechanics/MultiBody/Examples/package.mo": "package Examples Modelica.Fluid.Tank t; end Examples;",
    "Modelica 4.1.0/Thermal/package.mo": "within Modelica; package Thermal end Thermal;",
    "Modelica 4.1.0/Thermal/Port.mo": "connector Port end Port;",
    "Modelica 4.1.0/Thermal/Rod.mo": "model Rod end Rod;",
    "Modelica 4.1.0/Fluid/package.mo": "within Modelica; package Fluid end Fluid;",
    "Modelica 4.1.0/Fluid/Tank.mo": "model Tank end Tank;",
    "Modelica 4.1.0/Resources/large.bin": "x",
    "ModelicaServices 4.1.0/package.mo": "package ModelicaServices extends Modelica.Thermal.Rod; end ModelicaServices;",
    "ModelicaServices 4.1.0/Resources/large.bin": "x",
    "Complex 4.1.0.mo": "operator record Complex end Complex;",
}


def written(folder: Path, files: Mapping[str, str] = FILES) -> StandardLibrary:
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return library.standard({}, folder, folder)


@pytest.fixture
def small(tmp_path: Path) -> StandardLibrary:
    return written(tmp_path / "libraries")


@pytest.fixture
def cache(tmp_path: Path) -> Cache:
    return Cache(tmp_path / "cache")


def names(folder: Path) -> set[str]:
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()}


def test_what_multibody_needs_is_copied(small: StandardLibrary, cache: Cache) -> None:
    copied = copy(small, cache)
    left_out = ("Fluid", "Examples", "Resources")
    wanted = {name.replace(" 4.1.0", "") for name in FILES if not any(part in name for part in left_out)}
    assert names(copied) == wanted
    assert (copied / "Modelica/Mechanics/MultiBody/Body.mo").read_text() == FILES[
        "Modelica 4.1.0/Mechanics/MultiBody/Body.mo"
    ]


def test_the_order_of_a_package_names_what_is_there(small: StandardLibrary, cache: Cache) -> None:
    copied = copy(small, cache)
    order = (copied / "Modelica/package.order").read_text().split()
    assert order == ["UsersGuide", "Blocks", "Mechanics", "Thermal", "Units", "Inside"], "and what is inside a file"
    assert (copied / "Modelica/Mechanics/MultiBody/package.order").read_text() == "Body\nlocal\n"


def test_the_whole_library_is_copied_without_resources(small: StandardLibrary, cache: Cache) -> None:
    copied = copy(small, cache, whole=True)
    assert names(copied) == {name.replace(" 4.1.0", "") for name in FILES if "Resources" not in name}


@pytest.mark.parametrize(
    ("name", "covered"),
    [
        ("Modelica.Mechanics.MultiBody.Body", True),
        ("Modelica.Blocks.Sources.Sine", True),
        ("Modelica.Units.*", True),
        ("Modelica.Nonsense.At.All", True),
        ("Modelica.Fluid.Tank", False),
        ("Modelica.Fluid", False),
        ("Modelica.Thermal.*", True),
        ("Modelica.Mechanics.MultiBody.*", False),
        ("Modelica.Mechanics.MultiBody.Examples", False),
        ("Modelica.Blocks.Examples.Filter", False),
    ],
)
def test_a_copy_knows_what_it_lacks(name: str, covered: bool, small: StandardLibrary, cache: Cache) -> None:
    assert covers(small, copy(small, cache), [name]) is covered


def test_the_compiler_gets_as_little_as_will_do(small: StandardLibrary, cache: Cache) -> None:
    body = slim.roots(small, cache, ["model M Modelica.Mechanics.MultiBody.Body b; end M;"])
    tank = slim.roots(small, cache, ["import Modelica.Fluid; model M Fluid.Tank t; end M;"])
    assert body == (str(copy(small, cache)),)
    assert tank == (str(copy(small, cache, whole=True)),)


def test_a_copy_is_made_once(small: StandardLibrary, cache: Cache) -> None:
    copied = copy(small, cache)
    (copied / "mark").touch()
    os.utime(copied, (0, 0))
    assert copy(small, cache) == copied
    assert (copied / "mark").exists()
    assert copied.stat().st_mtime > 0, "its last use is noted"


def test_another_state_of_the_library_gets_a_copy_of_its_own(small: StandardLibrary, cache: Cache) -> None:
    first = copy(small, cache)
    os.utime(small.modelica.text, (1, 1))
    assert copy(small, cache) != first


def test_many_may_want_a_copy_at_the_same_time(small: StandardLibrary, cache: Cache) -> None:
    with ThreadPoolExecutor(8) as pool:
        copies = set(pool.map(lambda _: copy(small, cache), range(8)))
    assert [path.name for path in cache.libraries.iterdir()] == [copied.name for copied in copies]


def test_a_cache_that_is_no_folder_is_a_clear_error(small: StandardLibrary, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(CacheError, match="the cache can't be written to"):
        copy(small, Cache(tmp_path / "file" / "cache"))


def test_the_copy_of_the_real_one_is_closed(modelica_library: Path, cache: Cache) -> None:
    whole = library.standard({}, modelica_library, modelica_library)
    copied = copy(whole, cache)
    texts = [path.read_text("utf-8") for path in (copied / "Modelica" / "Mechanics").rglob("*.mo")]
    assert covers(whole, copied, references.mentioned(texts) - {"Modelica.Blocks.Examples"})
    assert len(names(copied)) < 700, "a quarter of all"
