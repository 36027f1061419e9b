"""What compiling a robot costs by its number of axes: `python tests/benchmarks/axes.py [--tool TOOL] [AXES …]`.

Each line is a row of the table in docs/speed.md: processor time with all imports, and the greatest memory. A package of
60 axes takes ten minutes and 16 GB with the embedded compiler.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path

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


def measure(axes: int, approach: str, tool: str, cache: str) -> str:
    """Simulate 0.2 s of a chain; return its seconds of processor time, and its memory."""
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "chain.urdf").write_text(chain(axes), encoding="utf-8")
        table = f'[robots.chain]\nsource = "chain.urdf"\npackage = "Chain"\napproach = ["{approach}"]\n'
        Path(folder, "urdfsync.toml").write_text(table, encoding="utf-8")
        simulate = ("simulate", "--stop", "0.2", "--tool", tool)
        # compilers with several threads wait busily for each other
        environment = os.environ | {"RAYON_NUM_THREADS": "1", "XDG_CACHE_HOME": cache}
        used = [_run([*_COMMAND, *words], folder, environment) for words in (("build", "-q"), simulate)]
    seconds = sum(one.ru_utime + one.ru_stime for one in used)
    return f"{seconds:.0f} s, {max(one.ru_maxrss for one in used) / 1e6:.1f} GB"


def _run(command: Sequence[str], folder: str, environment: Mapping[str, str]) -> resource.struct_rusage:
    """Run a command; return what it and its children have used."""
    process = subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.DEVNULL)
    _, status, used = os.wait4(process.pid, 0)
    if status:
        raise SystemExit(f"failed: {' '.join(command)}")
    return used


def main() -> None:
    """Print the rows of the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("axes", type=int, nargs="*", default=[6, 12, 20, 29])
    parser.add_argument("--tool", default="rumoca")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as cache:
        for approach in ("package", "record"):
            measure(1, approach, arguments.tool, cache)  # reads the library: once on each machine
        for axes in arguments.axes:
            package, record = (measure(axes, approach, arguments.tool, cache) for approach in ("package", "record"))
            print(f"| {axes} | {package} | {record} |", flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
