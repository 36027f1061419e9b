"""The functions of UrdfSync.Dynamics against Pinocchio: masses, forces, Jacobians of all links and poses, to 1e-12."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.functions import Functions
from test_generic import ROBOTS

pytestmark = pytest.mark.slow

CLOSE = 1e-12


@pytest.mark.parametrize("name", ROBOTS)
def test_functions_agree_with_pinocchio_in_random_configurations(
    modelica_library: Path, tmp_path: Path, name: str
) -> None:
    """Base and tool link as well; the Jacobians are those of all links, also behind fixed joints, and of the root."""
    worst = Functions(ROBOTS[name].encode()).worst(modelica_library, tmp_path)
    assert worst.keys() == {"found", "mass", "bias", "gravity", "jacobian", "poses"}
    assert max(worst.values()) < CLOSE, worst
