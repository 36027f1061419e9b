"""The copy of the needed part of the standard library."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from urdfsync.checking.cache import Cache, CacheError
from urdfsync.checking.libraries import library, references
from urdfsync.checking.libraries.library import LibraryError, StandardLibrary
from urdfsync.checking.libraries.slim import Copies

FILES = {
    "Modelica 4.1.0/package.mo": 'package Modelica annotation(version = "4.1.0"); end Modelica;',
    "Modelica 4.1.0/package.order": "UsersGuide\nBlocks\nMechanics\nFluid\nThermal\nUnits\nInside\n",
    **{
        f"Modelica 4.1.0/{name}.mo": "empty"
        for name in ("Constants", "Icons", "Math", "Units", "Utilities", "Mechanics/Rotational")
    },
    "Modelica 4.1.0/Mechanics/Translational/package.mo": "empty",
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


def copy(small: StandardLibrary, cache: Cache, *, whole: bool = False) -> Path:
    return Copies(small, cache).copy(whole=whole)


def names(folder: Path) -> set[str]:
    """The files in a copy, but for what counts them."""
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file()} - {"count.txt"}


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
    copies = Copies(small, cache)
    assert copies.covers(copies.copy(), [name]) is covered


def test_the_compiler_gets_as_little_as_will_do(small: StandardLibrary, cache: Cache) -> None:
    copies = Copies(small, cache)
    assert copies.roots({"Modelica.Mechanics.MultiBody.Body"}) == (str(copies.copy()),)
    assert copies.roots({"Modelica.Fluid.Tank"}) == (str(copies.copy(whole=True)),)


def test_a_copy_is_made_once(small: StandardLibrary, cache: Cache) -> None:
    copied = copy(small, cache)
    made = (copied / "count.txt").stat().st_ino
    os.utime(copied, (0, 0))
    assert copy(small, cache) == copied
    assert (copied / "count.txt").stat().st_ino == made
    assert copied.stat().st_mtime > 0, "its last use is noted"


def test_one_that_has_lost_files_is_made_again(small: StandardLibrary, cache: Cache) -> None:
    copied = copy(small, cache)
    before = names(copied)
    (copied / "Modelica" / "Thermal" / "Rod.mo").unlink()
    assert copy(small, cache) == copied
    assert names(copied) == before
    (copied / "count.txt").unlink()
    shutil.rmtree(copied / "Modelica")
    assert copy(small, cache) == copied
    assert names(copied) == before
    assert list(cache.libraries.iterdir()) == [copied]


def write_again(package: Path) -> None:
    (package / "Thermal" / "Rod.mo").write_text("model Rod Real T; end Rod;")


def take_away(package: Path) -> None:
    (package / "Thermal" / "Rod.mo").unlink()


def put_back_an_older_file(package: Path) -> None:
    os.utime(package / "Thermal" / "Rod.mo", (1, 1))


@pytest.mark.parametrize("change", [write_again, take_away, put_back_an_older_file])
def test_another_state_of_any_file_gets_a_copy_of_its_own(
    change: Callable[[Path], None], small: StandardLibrary, cache: Cache
) -> None:
    first = copy(small, cache)
    change(small.modelica.path)
    assert copy(small, cache) != first


def test_resources_are_no_part_of_that(small: StandardLibrary, cache: Cache) -> None:
    first = copy(small, cache)
    (small.modelica.path / "Resources" / "large.bin").write_text("y")
    assert copy(small, cache) == first


def fault(folder: Path, files: Mapping[str, str]) -> str:
    """What is said of a library of these files; nothing is copied."""
    cache = Cache(folder / "cache")
    with pytest.raises(LibraryError) as caught:
        copy(written(folder / "libraries", files), cache)
    assert not cache.folder.exists()
    (found,) = caught.value.diagnostics
    assert found.code == "broken-standard-library"
    assert "`library`" in found.hint
    return found.message.replace(str(folder / "libraries"), "")


def test_a_library_without_what_robots_need_is_a_clear_error(tmp_path: Path) -> None:
    without = {name: text for name, text in FILES.items() if "MultiBody" not in name}
    assert fault(tmp_path / "a", without) == (
        "the Modelica Standard Library in /Modelica 4.1.0 is broken: there is no `Modelica.Mechanics.MultiBody`"
    )
    alone = {name: text for name, text in FILES.items() if name.count("/") < 2 and "/package" in name}
    alone["Complex 4.1.0.mo"] = FILES["Complex 4.1.0.mo"]
    assert "there is no `Modelica.Blocks` and no `Modelica.Constants` and no" in fault(tmp_path / "b", alone)


@pytest.mark.parametrize("name", ["Modelica 4.1.0/package.mo", "Complex 4.1.0.mo"])
def test_so_is_one_with_an_empty_file(name: str, tmp_path: Path) -> None:
    library = name.partition(" ")[0]
    assert fault(tmp_path, FILES | {name: ""}).endswith(f"is broken: /{name} does not hold `{library}`")


def test_and_one_that_is_a_single_file(tmp_path: Path) -> None:
    files = {name: text for name, text in FILES.items() if not name.startswith("Modelica ")}
    message = fault(tmp_path, files | {"Modelica 4.1.0.mo": "package Modelica end Modelica;"})
    assert message.endswith("is broken: it is one file, and has to be a folder")


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
    copies = Copies(whole, cache)
    copied = copies.copy()
    texts = [path.read_text("utf-8") for path in (copied / "Modelica" / "Mechanics").rglob("*.mo")]
    assert copies.covers(copied, references.mentioned(texts) - {"Modelica.Blocks.Examples"})
    assert len(names(copied)) < 700, "a quarter of all"
