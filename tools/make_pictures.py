"""Makes the pictures of the documentation: `python tools/make_pictures.py [NAME…]`.

`terminal` is a conflict as people see it, with the arm of the tutorial. `axes` draws the table of simulations in
docs/speed.md. The others simulate what docs/simulate.md names: they need the extras `check` and `plot` and a Modelica
Standard Library, and take minutes.
"""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from rich.console import Console
from rich.text import Text

REPOSITORY = Path(__file__).parents[1]
IMAGES = REPOSITORY / "docs/images"
EXAMPLES = "UrdfSync.Examples"
URDFSYNC = (sys.executable, "-m", "urdfsync")
PICTURES = {
    "six_axis_arm_test": ["--stop", "5"],
    "computed_torque": ["--model", f"{EXAMPLES}.ComputedTorquePackage"],
    "tool_path": ["--model", f"{EXAMPLES}.ToolPathPackage"],
}
"""The arguments of `urdfsync simulate six_axis_arm` for each picture."""
WIDTH = 124
"""Columns of the terminal."""


def main() -> None:
    """Make all pictures, or those that the arguments name."""
    for name in sys.argv[1:] or ["terminal", "axes", *PICTURES]:
        picture = IMAGES / f"{name}.svg"
        if name == "terminal":
            picture.write_text(draw_conflict(), encoding="utf-8")
            continue
        if name == "axes":
            draw_axes(picture)
            continue
        command = [*URDFSYNC, "simulate", "six_axis_arm", *PICTURES[name], "--plot", str(picture)]
        subprocess.run(command, cwd=REPOSITORY, check=True)  # noqa: S603


def draw_axes(picture: Path) -> None:
    """Draw the processor time of simulations over the number of axes, from the table in docs/speed.md."""
    import matplotlib as mpl
    from matplotlib import pyplot

    page = (REPOSITORY / "docs/speed.md").read_text(encoding="utf-8")
    head, _, *rows = page.partition("\n| axes |")[2].partition("\n\n")[0].splitlines()
    mpl.rcParams["svg.hashsalt"] = "axes"
    figure, plot = pyplot.subplots(figsize=(7, 4), layout="constrained")
    for column, label in enumerate(filter(None, map(str.strip, head.split("|"))), start=2):
        cells = [(int(cells[1]), re.match(r" (\d+) s", cells[column])) for cells in (row.split("|") for row in rows)]
        points = [(axes, int(seconds[1])) for axes, seconds in cells if seconds]
        plot.plot(*zip(*points, strict=True), marker="o", label=label)
    plot.set(xlabel="axes", ylabel="processor time in s", xscale="log", yscale="log")
    ticks = [int(row.split("|")[1]) for row in rows]
    plot.set_xticks(ticks, map(str, ticks))
    plot.set_yticks([10, 20, 50, 100, 200, 500], ["10", "20", "50", "100", "200", "500"])
    plot.minorticks_off()
    plot.grid(alpha=0.3)
    plot.legend()
    figure.savefig(picture, metadata={"Date": None})


def draw_conflict() -> str:
    """Return the terminal after a build of the tutorial's arm, of which both sides have changed a mass."""
    page = (REPOSITORY / "docs/tutorial.md").read_text(encoding="utf-8")
    urdf = page.partition("```xml\n")[2].partition("```")[0]
    with tempfile.TemporaryDirectory() as place:
        source, record = (Path(place, name) for name in ("arm.urdf", "modelica/Arm/Links/Upper_armParameters.mo"))
        source.write_text(urdf, encoding="utf-8")
        for command in ("init", "build"):
            subprocess.run([*URDFSYNC, command, *(["arm.urdf"] * (command == "init")), "-q"], cwd=place, check=True)  # noqa: S603
        record.write_text(record.read_text(encoding="utf-8").replace("mass = 4,", "mass = 4.5,"), encoding="utf-8")
        source.write_text(urdf.replace('mass value="4"', 'mass value="4.2"'), encoding="utf-8")
        colours = os.environ | {"FORCE_COLOR": "1", "TERM": "xterm-256color", "COLUMNS": str(WIDTH)}
        done = subprocess.run([*URDFSYNC, "build"], cwd=place, env=colours, check=False, stdout=subprocess.PIPE)  # noqa: S603
    screen = Console(record=True, width=WIDTH, file=io.StringIO())
    screen.print(Text.from_ansi(f"$ urdfsync build\n{done.stdout.decode()}"))
    drawing = screen.export_svg(title="urdfsync", unique_id="terminal")
    return re.sub(r"@font-face \{.*?\}", "", drawing, flags=re.DOTALL)  # rich's fonts come from the network


if __name__ == "__main__":
    main()
