"""What compiling a robot costs by its number of axes: `python tests/benchmarks/axes.py [--tool TOOL] [AXES …]`.

Each line is a row of the table in docs/speed.md: processor time with all imports, and the greatest memory. A package of
43 axes takes nine minutes and 10 GB with the embedded compiler.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from pathlib import Path

sys.path[:1] = [str(folder) for folder in Path(__file__).resolve().parents[1:3]]

from benchmarks.measuring import measure  # noqa: E402

_COMMAND = (sys.executable, "-m", "urdfsync")
_INERTIAL = '<inertial><origin xyz="0 0 0.05"/><mass value="{mass:.3f}"/><inertia {inertia}/></inertial>'
_INERTIA = 'ixx="{0}" ixy="0" ixz="0" iyy="{0}" iyz="0" izz="{0}"'
_BOX = '<{0}><geometry><box size="0.1 0.1 0.1"/></geometry></{0}>'
_JOINT = """\
<joint name="j{number}" type="revolute"><parent link="l{before}"/><child link="l{number}"/><origin xyz="0 0 0.1"/>
  <axis xyz="{axis}"/><limit lower="-2" upper="2" effort="50" velocity="3"/><dynamics damping="0.5"/></joint>
"""


def chain(axes: int) -> str:
    """Return the URDF of a chain whose axes are in x and y by turns; all links but the first have boxes."""
    base = _INERTIAL.format(mass=3, inertia=_INERTIA.format(0.1))
    parts = [f'<robot name="chain">\n<link name="l0">{base}</link>\n']
    shapes = "".join(map(_BOX.format, ("visual", "collision")))
    for number in range(1, axes + 1):
        inertial = _INERTIAL.format(mass=0.2 + 1 / number, inertia=_INERTIA.format(0.01))
        parts.append(f'<link name="l{number}">{inertial}{shapes}</link>\n')
        axis = "1 0 0" if number % 2 else "0 1 0"
        parts.append(_JOINT.format(number=number, before=number - 1, axis=axis))
    return "".join([*parts, "</robot>\n"])


def cost(axes: int, approach: str, tool: str) -> str:
    """Build a chain and simulate 0.2 s of it; return the seconds of processor time, and the memory."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        (folder / "chain.urdf").write_text(chain(axes), encoding="utf-8")
        table = f'[robots.chain]\nsource = "chain.urdf"\npackage = "Chain"\napproach = ["{approach}"]\n'
        (folder / "urdfsync.toml").write_text(table, encoding="utf-8")
        simulate = ("simulate", "--stop", "0.2", "--tool", tool)
        costs = [measure([*_COMMAND, *words], folder) for words in (("build", "-q"), simulate)]
    return f"{sum(one.cpu for one in costs):.0f} s, {max(one.peak for one in costs) / 1e9:.1f} GB"


def main() -> None:
    """Print the rows of the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("axes", type=int, nargs="*", default=[6, 12, 20, 29])
    parser.add_argument("--tool", default="rumoca")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as cache:
        # compilers with several threads wait busily for each other
        os.environ |= {"RAYON_NUM_THREADS": "1", "XDG_CACHE_HOME": cache}
        for approach in ("package", "record"):
            cost(1, approach, arguments.tool)  # reads the library: once on each machine
        for axes in arguments.axes:
            package, record = (cost(axes, approach, arguments.tool) for approach in ("package", "record"))
            print(f"| {axes} | {package} | {record} |", flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
