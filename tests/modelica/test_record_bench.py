"""What the record approach writes can be simulated at once, or says why not; its motion is in test_generic."""

from __future__ import annotations

from pathlib import Path

import pytest
from support import generic, urdfs
from support.modelica import Run, Task, compile_task, execute
from support.packages import generate

from urdfsync.domain import Target

pytestmark = pytest.mark.slow

GOLDEN = Path(__file__).resolve().parents[1] / "golden"
PLANAR = urdfs.robot(
    urdfs.link("base"), urdfs.link("puck", 1), urdfs.joint("glide", "planar", "base", "puck", axis="0 0 1")
)
"""The generic robot can't take it."""
REFUSED = """
package Use_
  import Modelica;
  import UrdfSync;
  import Zoo;
  model Refused
    inner Modelica.Mechanics.MultiBody.World world(n = {{0, 0, -1}}, enableAnimation = false);
    UrdfSync.Robots.{form} robot(redeclare parameter Zoo.ZooParameters data);
  equation
    connect(world.frame_b, robot.frame_a);
  end Refused;
end Use_;
"""


def test_benches_can_be_simulated_at_once(modelica_library: Path, tmp_path: Path) -> None:
    targets = {"fixed": Target("Bolted", "Bolted"), "floating": Target("Free", "Free")}
    packages = [
        generate(GOLDEN / "twig.urdf", target, approach=("record",), base=base) for base, target in targets.items()
    ]
    packages.append(generate(PLANAR.encode(), Target("Zoo", "Zoo"), approach=("record",)))
    folders = [package.write(tmp_path) for package in packages]
    values = ("robot.r_0[1,3]", "robot.rotationalAxis[1].phi")
    tasks = [_bench(target.name, values) for target in targets.values()]
    refused = [Task(REFUSED.format(form=form), "Use_.Refused", [Run()]) for form in generic.FORMS]
    bolted, free, zoo, *forms = execute(
        modelica_library, folders, [*tasks, compile_task("Zoo.ZooParameters"), *refused]
    )
    assert (bolted.error, free.error, zoo.error) == ("", "", "")
    for form in forms:
        message = "Refused.robot: robot own has planar or floating joints, so its record has no tables. Use the package"
        assert message in form.runs[0].error
    height, angle = (bolted.runs[0].values[name] for name in values)
    assert set(height) == {0.0}
    assert angle[-1] > 0.001, "the axis has set out"
    fallen = free.runs[0].values[values[0]]
    assert fallen[-1] - fallen[0] == pytest.approx(-9.81 * 0.2**2 / 2, abs=0.01), "nothing holds it"


def _bench(name: str, values: tuple[str, ...]) -> Task:
    source = f"package Use\n  import Modelica;\n  import UrdfSync;\n  import {name};\n"
    source += f"  model Bench\n    extends {name}.{name}Generic;\n  end Bench;\nend Use;\n"
    return Task(source, "Use.Bench", [Run(0.2, 0.1)], values)
