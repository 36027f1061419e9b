"""The part of the Modelica Standard Library that multibody models need.

The compiler reads a root as a whole; the copy takes a fifth of the time and of the memory.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import tempfile
from collections.abc import Mapping
from pathlib import Path

CACHE = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "urdfsync-tests"
"""Stays from run to run, since the compiler's first look at a library takes seconds; may be deleted."""

_PARTS = ("package.mo", "Constants.mo", "Icons.mo", "Units.mo", "Math", "Mechanics", "Blocks", "Utilities", "Thermal")
_UNNEEDED = frozenset(
    """
    Examples UsersGuide Resources Blocks/Noise Blocks/Tables Blocks/Nonlinear Blocks/Discrete Blocks/MathBoolean
    Blocks/MathInteger Math/Distributions Math/Random Math/Nonlinear Math/FastFourierTransform Math/Polynomials
    Math/Special Thermal/FluidHeatFlow Mechanics/MultiBody/Joints/Assemblies Mechanics/MultiBody/Visualizers/Colors
    """.split()
)


def slim_library(library: Path) -> Path:
    """The copy of the library found in the folder `library`, made once a machine."""
    sources = {name: _entry(library, name) for name in ("Modelica", "ModelicaServices", "Complex.mo")}
    version = hashlib.sha256(repr((sorted(map(str, sources.values())), _PARTS, sorted(_UNNEEDED))).encode()).hexdigest()
    target = CACHE / f"library-{version[:12]}"
    if not target.is_dir():
        CACHE.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=CACHE) as folder:
            copy = Path(folder) / "library"
            _copy(sources, copy)
            if not target.is_dir():  # another process may have been faster
                copy.rename(target)
    return target


def _entry(library: Path, name: str) -> Path:
    stem, suffix = name.removesuffix(".mo"), ".mo" if name.endswith(".mo") else ""
    versions = sorted(library.glob(f"{stem} [4-9]*{suffix}"))
    return library / name if (library / name).exists() else versions[-1]


def _copy(sources: Mapping[str, Path], target: Path) -> None:
    def unneeded(folder: str, names: list[str]) -> set[str]:
        below = Path(folder).relative_to(sources["Modelica"]).as_posix()
        return {name for name in names if {name.removesuffix(".mo"), f"{below}/{name.removesuffix('.mo')}"} & _UNNEEDED}

    modelica = target / "Modelica"
    modelica.mkdir(parents=True)
    for part in _PARTS:
        source = sources["Modelica"] / part
        if source.is_dir():
            shutil.copytree(source, modelica / part, ignore=unneeded)
        else:
            shutil.copy(source, modelica / part)
    shutil.copytree(
        sources["ModelicaServices"], target / "ModelicaServices", ignore=shutil.ignore_patterns("Resources")
    )
    shutil.copy(sources["Complex.mo"], target / "Complex.mo")
    for order in target.rglob("package.order"):
        _prune(order)


def _prune(order: Path) -> None:
    """Take the names out of a `package.order` whose files were not copied; names inside `package.mo` stay."""
    folder = order.parent
    inside = (folder / "package.mo").read_text("utf-8")
    names = order.read_text("utf-8").split()
    kept = [
        name for name in names if (folder / name).exists() or (folder / f"{name}.mo").exists() or f" {name}" in inside
    ]
    order.write_text("".join(f"{name}\n" for name in kept), "utf-8")
