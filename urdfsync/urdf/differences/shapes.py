"""What a link's model says of its visuals and collisions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal, NamedTuple, TypeAlias

import msgspec

from urdfsync.domain import Import
from urdfsync.urdf.meshes import lookup
from urdfsync.urdf.options import Options
from urdfsync.urdf.robot import Mesh

Group: TypeAlias = Literal["visuals", "collisions"]
GROUPS: tuple[Group, ...] = ("visuals", "collisions")


class Look(NamedTuple):
    """What a model says of a shape."""

    kind: str
    touches: bool
    """Whether it has a ground contact."""


class Looks(msgspec.Struct, frozen=True):
    """How one version's shapes appear in models; `imports` are None if nobody looked for the meshes."""

    imports: Mapping[str, Import] | None
    options: Options

    def of(self, link: Mapping[str, Any], group: Group, index: int) -> Look | None:
        """The look of a link's shape; None if it has no such shape or its model does not show it."""
        shapes = link[group]
        return self.look(shapes[index], group) if index < len(shapes) else None

    def look(self, shape: Mapping[str, Any], group: Group) -> Look | None:
        """The look of a shape; None if it is left out, as shapes without their mesh are."""
        if group == "collisions" and not self.options.collisions:
            return None
        contact = self.options.base == "floating" and group == "collisions"
        kind, key = shape["geometry"]["kind"], mesh_of(shape)
        if key is None:
            return Look(kind, contact)
        if self.options.meshes != "import":
            return None
        if self.imports is None:
            return Look(kind, contact)
        found = self.imports.get(key)
        return None if found is None else Look(kind, contact and bool(found.facts["hull"]))


def mesh_of(shape: Mapping[str, Any]) -> str | None:
    """The key of a shape's mesh among the imports; None for other shapes."""
    geometry = shape["geometry"]
    return lookup.key(Mesh(geometry["filename"], tuple(geometry["scale"]))) if geometry["kind"] == "mesh" else None
