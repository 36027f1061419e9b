"""Orientations as MuJoCo has them: quaternions w, x, y, z."""

from __future__ import annotations

from typing import Any, TypeAlias

import mujoco
import numpy as np
from numpy.typing import NDArray

from urdfsync.formats.translation.writer import rounded
from urdfsync.formats.urdf.kinematics.poses import roll_pitch_yaw

Array: TypeAlias = NDArray[np.float64]


def rpy(quaternion: Any) -> tuple[float, ...]:
    """Return the angles of a quaternion as URDF writes them."""
    w, x, y, z = map(float, quaternion)
    return rounded(roll_pitch_yaw((x, y, z, w)))


def turned(quaternion: Any, vector: Any) -> Array:
    """Return a vector turned by a quaternion."""
    result = np.zeros(3)
    mujoco.mju_rotVecQuat(result, np.asarray(vector, float), np.asarray(quaternion, float))
    return result
