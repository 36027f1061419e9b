"""The golden texts: what the shipped templates write, as the repository has it.

`python -m tests --renew` writes all of them anew; review what changed. Golden are

- the library's own links and joints, which can be used without a generated package,
- its Examples, by `urdfsync.toml`: nobody edits these packages, so their state is not committed,
- below `tests/golden/VARIANT`, only texts that show more of a template than the texts before.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import msgspec

from support.corpus import REPOSITORY
from support.library import library_artifacts
from support.packages import RENDERER, Package, generate
from urdfsync.common.files import text_hash
from urdfsync.domain import Artifact, Order, Target
from urdfsync.engine.decide.parts import file_ids
from urdfsync.engine.package.render import Renderer
from urdfsync.formats.urdf.artifacts import record
from urdfsync.formats.urdf.options import Options
from urdfsync.modelica.stamp import Stamp, stamped
from urdfsync.project import config

GOLDEN = REPOSITORY / "tests" / "golden"
LIBRARY = REPOSITORY / "modelica" / "UrdfSync"
TEMPLATES = REPOSITORY / "templates" / "urdf"
TARGETS = {
    "menagerie": Target("Zoo.Menagerie", "Menagerie"),
    "twig": Target("Zoo.Twig", "Twig"),
    "rig": Target("Rig", "Rig"),
    "mill": Target("Zoo.Mill", "Mill"),
    "post": Target("Post", "Post"),
    "hoist": Target("Hoist", "Hoist"),
}
"""Sources below `tests/golden`, and the names of their packages."""


class Variant(NamedTuple):
    """A source with options."""

    source: str
    options: Mapping[str, Any] = {}


VARIANTS: Mapping[str, Variant] = {
    "fixed": Variant("menagerie"),
    "floating": Variant("menagerie", {"base": "floating"}),
    "record": Variant("twig", {"approach": ("record",)}),
    "laws": Variant(
        "rig",
        {
            "friction": {"waist": "lugre", "lift": "stiction", "push": "lugre", "tilt": "stiction"},
            "elastic": ("waist", "lift", "push", "tilt"),
            "saturated": ("waist", "lift", "push"),
            "commands": {"waist": "velocity", "lift": "velocity", "push": "effort", "tilt": "effort"},
            "start": {"waist": 0.5},
        },
    ),
    "motors": Variant(
        "rig",
        {
            "drives": "motor",
            "inputs": "vector",
            "base": "floating",
            "saturated": "all",
            "commands": {"waist": "effort", "lift": "effort"},
            "start": {"lift": 0.25, "tilt": 0.5},
            "approach": ("package", "record"),
        },
    ),
    "loops": Variant(
        "mill",
        {
            "base": "floating",
            "inputs": "vector",
            "start": {"ram": 0.3, "block": 0.4, "shoe_pin": 2.2143, "crank": 1.2},
            "approach": ("package", "record"),
        },
    ),
    "servos": Variant("hoist", {"saturated": ("swing", "rope")}),
    "vector": Variant("hoist", {"saturated": ("drum", "fan"), "inputs": "vector"}),
    "bare": Variant("post", {"inputs": "vector", "approach": ("package", "record")}),
}


@functools.cache
def golden(variant: str) -> Package:
    """The package of a variant."""
    source, options = VARIANTS[variant]
    return generate(GOLDEN / f"{source}.urdf", TARGETS[source], **options)


@functools.cache
def distinct_models() -> Mapping[str, Mapping[str, str]]:
    """The models of each variant that no earlier variant of its source has, golden or not."""
    found: dict[str, Mapping[str, str]] = {}
    for name, (source, _) in VARIANTS.items():
        earlier = [set(golden(each).texts.items()) for each in found if VARIANTS[each].source == source]
        found[name] = dict(set(golden(name).models.items()).difference(*earlier))
    return {name: dict(sorted(models.items())) for name, models in found.items()}


class Piece(NamedTuple):
    """A file of the repository that a template writes."""

    file: Path
    artifact: Artifact | Order
    is_librarys: bool = False
    """Whether it is one of the library's own links and joints: users can replace their records."""
    id: str = ""
    """The id in its stamp, if a build writes it."""

    def text(self, renderer: Renderer = RENDERER) -> str:
        """Return the text that the templates write."""
        if isinstance(self.artifact, Order):
            return "".join(f"{name}\n" for name in self.artifact.names)
        text = renderer.render(self.artifact.template, self.artifact.data)
        return text.replace("    redeclare ", "    redeclare replaceable ", 1) if self.is_librarys else text

    def content(self) -> bytes:
        """Return the content of the file."""
        text = self.text()
        return (stamped(text, Stamp(self.id, text_hash(text.encode()))) if self.id else text).encode()


@functools.cache
def examples() -> Mapping[Path, Package]:
    """The library's Examples, by the folders of their packages."""
    robots = config.load(REPOSITORY / "urdfsync.toml").robots
    return {each.folder: generate(each.source, each.target, **msgspec.structs.asdict(each.options)) for each in robots}


@functools.cache
def pieces() -> tuple[Piece, ...]:
    """All golden texts."""
    library = [Piece(LIBRARY / each.path, each, is_librarys=True) for each in library_artifacts()]
    generated = list[Piece]()
    for folder, made in examples().items():
        ids = file_ids([each for each in made.artifacts if isinstance(each, Artifact)], {})
        generated += [Piece(folder / each.path, each, id=ids.get(each.path, "")) for each in made.artifacts]
    return *library, *generated, *(piece for piece in of_variants() if piece.file.is_file())


def of_variants() -> Iterator[Piece]:
    """Yield all texts of the variants, and a record outside of a package; those on disk are golden."""
    for variant in VARIANTS:
        yield from (Piece(GOLDEN / variant / each.path, each) for each in golden(variant).artifacts)
    alone = record(golden("bare").robot, Target("", "PostParameters"), Options(approach=("record",)))
    yield Piece(GOLDEN / "alone" / alone.path, alone)


def expected() -> dict[Path, bytes]:
    """The golden files: texts, and the meshes of Examples."""
    meshes = {folder / path: mesh for folder, made in examples().items() for path, mesh in made.imports.items()}
    return meshes | {piece.file: piece.content() for piece in pieces()}


def on_disk() -> dict[Path, bytes]:
    """The files at the places of golden ones."""
    folders = [LIBRARY / "Links", LIBRARY / "Joints", *examples(), *(GOLDEN / name for name in (*VARIANTS, "alone"))]
    files = (path for folder in folders for path in folder.rglob("*") if path.is_file())
    by_hand = {LIBRARY / "Links/package.mo", LIBRARY / "Joints/package.mo"}
    return {path: path.read_bytes() for path in files if path not in by_hand}
