"""How fast `urdfsync watch` is, and what it costs: latency, idling, memory.

Latency is the time from the moment at which an edited source is in place to the moment at which the record of the
element has the new mass, in a daemon that is told to wait for nothing (`--settle 0 --sample 0`):
what is left is what comes after settling, and the way of the event to the daemon. The record is looked at every
0.5 ms, by a process that does nothing else; that is included.

Idling is measured with 50 robots that have 200 MB of meshes; memory is what the process holds (RSS), there and over
many rebuilds. Reads /proc, so it needs Linux.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import time
from collections.abc import Iterator
from pathlib import Path

from support.corpus import REPOSITORY
from support.daemon import LIMIT, Watch

from benchmarks.measuring import Cost, Quantity, UnexpectedError, run
from benchmarks.robots import PLAIN, Source, write_workspace
from benchmarks.study import Figures, Row, Study, scaled
from benchmarks.tools import NOTHING, Tools

ARM = REPOSITORY / "modelica" / "UrdfSync" / "Resources" / "robots" / "six_axis_arm"
BARS: dict[int, float] = {11: 15, 133: 40, 1000: 250}
"""Milliseconds at most, by the number of links, where `python -c pass` takes `REFERENCE`."""
REFERENCE = 12.0
ROBOTS, MEGABYTES = 50, 200
_AT_ONCE = ("--settle", "0", "--sample", "0", "--rescan", "3600")
_POLL = 0.0001
_QUIET = 0.3
"""Seconds in which a daemon that has done its work uses no processor time."""
_STEPS = 5
"""So often memory is told while it rebuilds."""


def studies(tools: Tools) -> Iterator[Study | Figures]:
    """What is measured."""
    yield from _latencies(tools, "one mass changed in the daemon, without cross-check", PLAIN)
    yield from _latencies(tools, "one mass changed in the daemon, with cross-check", "")
    if tools.idle:
        yield _idle(tools.folder / "idle", tools)
    if tools.rebuilds:
        yield _memory(tools.folder / "memory", tools.rebuilds)


class Edits:
    """A daemon and the robot that it watches; each call changes a mass."""

    def __init__(self, watch: Watch, folder: Path, link: str) -> None:
        """`link` is the first one that has a mass."""
        self._watch, self._source = watch, Source(folder / "robot0.urdf")
        self._record = folder / f"modelica/Robot0/Links/{link}Parameters.mo"

    def __call__(self) -> Cost:
        """The time until its record has been replaced, and what the daemon's threads ran meanwhile."""
        watch = self._watch
        _rest(watch.process.pid)
        since, before = watch.mark, self._state()
        used, wanted = _running(watch.process.pid), self._source.edit()
        begin = time.perf_counter()
        while before == self._state():
            if time.perf_counter() - begin > LIMIT:
                raise TimeoutError(watch.said)
            time.sleep(_POLL)
        cost = Cost(time.perf_counter() - begin, _running(watch.process.pid) - used)
        watch.wait("built", lambda event: bool(event["files"]), since)
        if f"mass = {wanted}," not in self._record.read_text(encoding="utf-8"):
            raise UnexpectedError(f"{self._record} does not have the mass {wanted}")
        return cost

    def _state(self) -> tuple[int, int]:
        """What tells whether the record has been replaced or written."""
        state = self._record.stat()
        return state.st_ino, state.st_mtime_ns


def _latencies(tools: Tools, title: str, beginning: str) -> Iterator[Study]:
    with contextlib.ExitStack() as stack:
        found = {NOTHING: tools.nothing}
        for links in BARS:
            place = write_workspace(tools.folder / f"{title} {links}", 1, links, beginning)
            watch = stack.enter_context(Watch(place, *_AT_ONCE))
            watch.rest()
            found[f"{links:,} links"] = Edits(watch, place, "Link0")
        rows = [Row(f"{links:,} links", NOTHING, bar, reading=scaled(REFERENCE)) for links, bar in BARS.items()]
        rows += [Row(f"{links:,} links", NOTHING, None, Quantity.CPU, scaled(REFERENCE)) for links in BARS]
        yield Study(title, found, rows)


def _idle(project: Path, tools: Tools) -> Figures:
    project.mkdir(parents=True)
    lines = []
    for number in range(ROBOTS):
        lines.append(f'[robots.r{number}]\nsource = "cad/r{number}/arm.urdf"\npackage = "R{number}"\n')
        _mesh(project / f"cad/r{number}/big.obj", MEGABYTES * 1_000_000 // ROBOTS, number)
        text = (ARM / "six_axis_arm.urdf").read_text()
        shape = '<visual><geometry><mesh filename="big.obj"/></geometry></visual>'
        link = f'<link name="big">{shape}</link>'
        joint = f'<joint name="on" type="fixed"><parent link="{_root(text)}"/><child link="big"/></joint>'
        (project / f"cad/r{number}/arm.urdf").write_text(text.replace("</robot>", f"{link}{joint}</robot>"))
    (project / "urdfsync.toml").write_text("".join(lines))
    run(tools.urdfsync("build", "--quiet"), project)
    files = sum(path.is_file() for path in (project / "modelica").rglob("*"))
    with Watch(project) as watch:
        begin = time.monotonic()
        watch.rest(robots=ROBOTS)
        ready = time.monotonic() - begin
        time.sleep(10)
        pid, used, since = watch.process.pid, _cpu(watch.process.pid), time.monotonic()
        time.sleep(tools.idle)
        share = (_cpu(pid) - used) / (time.monotonic() - since)
        memory, threads = _rss(pid), len(list(Path(f"/proc/{pid}/task").iterdir()))
    values = [
        ("processor time", f"{share:.2%} of one core, over {tools.idle:g} s"),
        ("memory", f"{memory:.0f} MB"),
        ("threads", f"{threads}"),
        ("caught up after", f"{ready:.1f} s"),
    ]
    return Figures(f"idle: {ROBOTS} robots, {MEGABYTES} MB of meshes, {files:,} outputs", values)


def _memory(folder: Path, rebuilds: int) -> Figures:
    shutil.copytree(ARM, folder)
    (folder / "six_axis_arm.urdf").rename(folder / "arm.urdf")
    (folder / "urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    source, values = Source(folder / "arm.urdf"), []
    marks = {rebuilds // _STEPS // 2, *range(rebuilds // _STEPS, rebuilds + 1, max(1, rebuilds // _STEPS))}
    with Watch(folder, "--settle", "0", "--sample", "0") as watch:
        watch.rest()
        begin = time.monotonic()
        for number in range(1, rebuilds + 1):
            since = watch.mark
            source.edit()
            watch.wait("built", lambda event: bool(event["files"]), since)
            if number in marks:
                each = (time.monotonic() - begin) / number
                values.append((f"{number} rebuilds", f"{_rss(watch.process.pid):.1f} MB, {each:.3f} s each"))
    return Figures("memory of the daemon over rebuilds", values)


def _rest(pid: int) -> None:
    """Wait until a daemon uses no more processor time."""
    end = time.monotonic() + LIMIT
    used = -1.0
    while used != (used := _cpu(pid)):
        if time.monotonic() > end:
            raise TimeoutError("the daemon does not come to rest")
        time.sleep(_QUIET)


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


def _running(pid: int) -> float:
    """Seconds that a process has run, with threads that have ended: its clock, as `clock_getcpuclockid` names it."""
    return time.clock_gettime((~pid << 3) | 2)


def _rss(pid: int) -> float:
    """Megabytes in memory."""
    return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6
