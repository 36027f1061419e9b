"""How fast `urdfsync watch` is, and what it costs: latency, idling, memory.

    python tests/benchmarks/bench_watch.py [--edits N] [--idle S] [--rebuilds N]

Latency is the time from the last byte of a small edit of the six-axis example to the written record that holds it,
beside the settle time, which is part of it. Idling is measured with 50 robots that have 200 MB of meshes; memory is
what the process holds (RSS), there and over many rebuilds. Reads /proc, so it needs Linux.
"""

from __future__ import annotations

import argparse
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from rich.console import Console
from rich.table import Table
from support.daemon import LIMIT, REPOSITORY, Watch

ROBOT = REPOSITORY / "modelica" / "UrdfSync" / "Resources" / "robots" / "six_axis_arm"
MASS = '<mass value="'
TIMES = ((0, 0), (300, 200))
"""Quiet time and time between samples, in milliseconds."""
ROBOTS, MEGABYTES = 50, 200
STEPS = 5
"""So often memory is printed while it rebuilds."""


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--edits", type=int, default=21, help="edits per settle time (default: 21)")
    parser.add_argument("--idle", type=float, default=60, help="seconds to idle (default: 60)")
    parser.add_argument("--rebuilds", type=int, default=500, help="rebuilds for the memory (default: 500)")
    options = parser.parse_args()
    console = Console()
    with tempfile.TemporaryDirectory() as folder:
        if options.edits:
            console.print(_latencies(Path(folder), options.edits))
        if options.idle:
            console.print(_idle(Path(folder) / "idle", options.idle))
        if options.rebuilds:
            console.print(_memory(Path(folder) / "memory", options.rebuilds))


def _latencies(folder: Path, edits: int) -> Table:
    table = Table(title=f"from the last byte of an edit to the written record, {edits} edits, ms")
    for title in ("settle time", "median", "of that after settling", "fastest", "slowest"):
        table.add_column(title, justify="right")
    for settle, sample in TIMES:
        project = _project(folder / f"{settle}")
        with Watch(project, "--settle", f"{settle}", "--sample", f"{sample}") as watch:
            watch.rest()
            time.sleep(3)  # it loads what builds need after its first one
            found = [1000 * _edit(project, watch, number) for number in range(1, edits + 1)]
        median, total = statistics.median(found), settle + sample
        table.add_row(*(f"{ms:.0f}" for ms in (total, median, median - total, min(found), max(found))))
    return table


def _edit(project: Path, watch: Watch, number: int) -> float:
    """Change the mass of a link; returns the seconds until its record says so."""
    since, records = watch.mark, list((project / "modelica/Arm/Links").glob("*Parameters.mo"))
    wanted = _rewrite(project, number)
    begin = time.perf_counter()
    while not any(f"mass = {wanted}," in record.read_text() for record in records):
        if time.perf_counter() - begin > LIMIT:
            raise TimeoutError(watch.said)
        time.sleep(0.001)
    took = time.perf_counter() - begin
    watch.wait("built", since=since)
    time.sleep(0.3)  # the daemon makes sure that nobody else wrote
    return took


def _idle(project: Path, seconds: float) -> str:
    project.mkdir(parents=True)
    lines = []
    for number in range(ROBOTS):
        lines.append(f'[robots.r{number}]\nsource = "cad/r{number}/arm.urdf"\npackage = "R{number}"\n')
        _mesh(project / f"cad/r{number}/big.obj", MEGABYTES * 1_000_000 // ROBOTS, number)
        text = (ROBOT / "six_axis_arm.urdf").read_text()
        shape = '<visual><geometry><mesh filename="big.obj"/></geometry></visual>'
        link = f'<link name="big">{shape}</link>'
        joint = f'<joint name="on" type="fixed"><parent link="{_root(text)}"/><child link="big"/></joint>'
        (project / f"cad/r{number}/arm.urdf").write_text(text.replace("</robot>", f"{link}{joint}</robot>"))
    (project / "urdfsync.toml").write_text("".join(lines))
    subprocess.run([sys.executable, "-m", "urdfsync", "build", "-q"], cwd=project, check=True, env=_environment())
    files = sum(path.is_file() for path in (project / "modelica").rglob("*"))
    with Watch(project) as watch:
        begin = time.monotonic()
        watch.rest(robots=ROBOTS)
        ready = time.monotonic() - begin
        time.sleep(10)
        pid, used, since = watch.process.pid, _cpu(watch.process.pid), time.monotonic()
        time.sleep(seconds)
        share = (_cpu(pid) - used) / (time.monotonic() - since)
        memory, threads = _rss(pid), len(list(Path(f"/proc/{pid}/task").iterdir()))
    return (
        f"idle for {seconds:g} s, {ROBOTS} robots, {MEGABYTES} MB of meshes, {files} outputs: {share:.2%} of one core, "
        f"{memory:.0f} MB, {threads} threads; caught up after {ready:.1f} s"
    )


def _memory(project: Path, rebuilds: int) -> Table:
    table = Table(title="memory over rebuilds")
    for title in ("rebuilds", "MB", "seconds each"):
        table.add_column(title, justify="right")
    _project(project)
    with Watch(project, "--settle", "0", "--sample", "0") as watch:
        watch.rest()
        begin = time.monotonic()
        for number in range(1, rebuilds + 1):
            since = watch.mark
            _rewrite(project, number)
            watch.wait("built", lambda event: bool(event["files"]), since)
            if number % (rebuilds // STEPS) == 0 or number == rebuilds // STEPS // 2:
                each = (time.monotonic() - begin) / number
                table.add_row(f"{number}", f"{_rss(watch.process.pid):.1f}", f"{each:.3f}")
    return table


def _rewrite(project: Path, number: int) -> str:
    """Change the mass of a link; returns the new one, in kg."""
    source, mass = project / "arm.urdf", f"{17 + number / 1000:g}"
    head, rest = source.read_text().split(MASS, 1)
    source.write_text(f"{head}{MASS}{mass}{rest[rest.index(chr(34)) :]}")
    return mass


def _project(folder: Path) -> Path:
    shutil.copytree(ROBOT, folder)
    (folder / "six_axis_arm.urdf").rename(folder / "arm.urdf")
    (folder / "urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    return folder


def _root(text: str) -> str:
    return text.split('<link name="', 1)[1].split('"', 1)[0]


def _mesh(path: Path, size: int, number: int) -> None:
    """An OBJ file of so many bytes, most of them comments: hashing it takes what it takes, importing it is quick."""
    path.parent.mkdir(parents=True)
    comment = f"# part {number}\n" * (size // 10)
    path.write_text(f"{comment[:size]}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")


def _cpu(pid: int) -> float:
    """Seconds of processor time."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def _rss(pid: int) -> float:
    """Megabytes in memory."""
    return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


def _environment() -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(REPOSITORY)}


if __name__ == "__main__":
    main()
