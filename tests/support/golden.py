"""The golden packages: what the shipped templates write, once in each way that they can write it.

`tests/golden/NAME` has the texts of the variant `NAME`. `python tests/urdf/test_artifacts.py` renews them.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from support.corpus import REPOSITORY
from support.packages import Package, generate
from urdfsync.domain import Artifact, Target
from urdfsync.engine.render import Renderer

GOLDEN = REPOSITORY / "tests" / "golden"
TEMPLATES = REPOSITORY / "templates" / "urdf"
TARGETS = {
    "menagerie": Target("Zoo.Menagerie", "Menagerie"),
    "twig": Target("Zoo.Twig", "Twig"),
    "rig": Target("Rig", "Rig"),
    "mill": Target("Zoo.Mill", "Mill"),
}
"""Sources below `tests/golden`, and the names of their packages."""


class Variant(NamedTuple):
    """A source with options."""

    source: str
    options: Mapping[str, Any] = {}
    files: str = ""
    """A pattern of the paths to keep; the other files show nothing new."""


VARIANTS: Mapping[str, Variant] = {
    "fixed": Variant("menagerie"),
    "floating": Variant("menagerie", {"base": "floating"}),
    "visualization2": Variant("menagerie", {"visualizer": "visualization2"}),
    "no-collisions": Variant("menagerie", {"collisions": False}),
    "whole": Variant("menagerie", {"approach": ("record",)}, "MenagerieParameters"),
    "record": Variant("twig", {"approach": ("record",)}),
    "laws": Variant(
        "rig",
        {
            "friction": {"waist": "lugre", "lift": "stiction", "push": "lugre", "tilt": "stiction"},
            "elastic": ("waist", "lift", "push", "tilt"),
            "saturated": ("waist", "lift"),
            "commands": {"lift": "velocity", "push": "effort", "tilt": "velocity"},
            "start": {"waist": 0.5},
        },
        "Rig|Joints/(?!Caster|Fan|Flex|Rack)|package|Links/Base",
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
        "Rig|Joints/(?!Caster|Fan|Flex|Rack)|Links/Base",
    ),
    "loops": Variant(
        "mill",
        {
            "base": "floating",
            "inputs": "vector",
            "start": {"ram": 0.3, "block": 0.4, "shoe_pin": 2.2143, "crank": 1.2},
            "approach": ("package", "record"),
        },
        "Mill|Joints/(Die|Hook)",
    ),
}
"""Later variants of a source have only the texts that differ from its first one."""


@functools.cache
def golden(variant: str) -> Package:
    """The package of a variant."""
    source, options, _ = VARIANTS[variant]
    return generate(GOLDEN / f"{source}.urdf", TARGETS[source], **options)


def texts_to_keep(variant: str) -> dict[str, str]:
    """The golden texts of a variant."""
    source, _, files = VARIANTS[variant]
    first = next(name for name, each in VARIANTS.items() if each.source == source)
    common = {} if variant == first else golden(first).texts
    texts = golden(variant).texts.items()
    return {path: text for path, text in texts if common.get(path) != text and re.match(files, path)}


def rendered(variant: str, renderer: Renderer) -> dict[str, str]:
    """The golden texts of a variant, by other templates."""
    wanted = kept(variant).keys()
    artifacts = (each for each in golden(variant).artifacts if isinstance(each, Artifact) and each.path in wanted)
    return {each.path: renderer.render(each.template, each.data) for each in artifacts}


def kept(variant: str) -> dict[str, str]:
    """The golden texts of a variant, as they are on disk."""
    folder = GOLDEN / variant
    files = (path for path in folder.rglob("*") if path.is_file())
    return {path.relative_to(folder).as_posix(): path.read_bytes().decode() for path in files}
