"""The functions of UrdfSync.Dynamics against Pinocchio: masses, forces, Jacobians of all links and poses, to 1e-12.

For the robots of the corpus, `python tests/generic_corpus.py functions` does it.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from support.functions import EQUATIONS, SAMPLED, Form, Functions, errors
from support.modelica import Run, Task, simulate
from support.packages import generate
from support.urdfs import joint, link, robot
from test_generic import ROBOTS, STONE

from urdfsync.domain import Target

pytestmark = pytest.mark.slow

CLOSE = 1e-12
STILL = {"stone": STONE, "statue": robot(link("base", 1.0), link("head", 2.0), joint("neck", "fixed", "base", "head"))}
"""No moving joint: tables and results are empty, but for poses."""
CASES = {
    "gripper": (ROBOTS["gripper"], SAMPLED),
    **{name: (text, EQUATIONS) for name, text in {"ladder": ROBOTS["ladder"], **STILL}.items()},
}
LONG_AXIS = """
package Axes_
  import Modelica;
  import UrdfSync;
  import Bot;
  model Axes
    parameter Bot.BotParameters data(shoulder(axis = {1.2, 0, 1.6}));
    Real axis[3] = data.turnAxes[1, :];
  end Axes;
end Axes_;
"""
"""An axis of the gripper is edited by hand; its direction is as before, its length is not."""


@pytest.mark.parametrize(("text", "form"), CASES.values(), ids=CASES)
def test_functions_agree_with_pinocchio_in_random_configurations(
    modelica_library: Path, tmp_path: Path, text: str, form: Form
) -> None:
    """Base and tool link as well; the Jacobians are those of all links, also behind fixed joints, and of the root."""
    worst = Functions(text.encode()).worst(modelica_library, tmp_path, form)
    assert worst.keys() == {"found", "mass", "inertias", "bias", "gravity", "jacobian", "places", "turns"}
    assert max(worst.values()) < CLOSE, worst


def test_an_error_in_any_element_of_any_result_is_found() -> None:
    """However small it is beside the greatest element."""
    expected = Functions(ROBOTS["gripper"].encode()).expected(1)
    assert max(errors(expected, expected).values()) == 0
    for part, array in expected.items():
        size = max(abs(expected["mass"]).max(), abs(array).max(), 1)
        for place in np.ndindex(array.shape):
            wrong = array.astype(float)
            wrong[place] += 2 * CLOSE * size
            found = errors({**expected, part: wrong}, expected)
            assert [name for name, error in found.items() if error > CLOSE] == [part], place


def test_an_axis_of_any_length_counts_as_a_direction(modelica_library: Path, tmp_path: Path) -> None:
    """As in the joints of the package."""
    folder = generate(ROBOTS["gripper"].encode(), Target("Bot", "Bot"), approach=("record",)).write(tmp_path)
    values = [f"axis[{i}]" for i in (1, 2, 3)]
    (series,) = simulate(modelica_library, [folder], [Task(LONG_AXIS, "Axes_.Axes", [Run()], values)])
    assert [series.values[value][0] for value in values] == pytest.approx([0.6, 0, 0.8], abs=CLOSE)
