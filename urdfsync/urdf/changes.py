"""What the URDF domain knows about changes: see `urdfsync.changes.Comparing`."""

from __future__ import annotations

from urdfsync.urdf.differences.comparable import comparable
from urdfsync.urdf.differences.effects import effects
from urdfsync.urdf.differences.interface import interface
from urdfsync.urdf.differences.meanings import describe
from urdfsync.urdf.differences.renames import renames

__all__ = ["comparable", "describe", "effects", "interface", "renames"]
