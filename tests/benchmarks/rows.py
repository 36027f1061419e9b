"""The rows of the speed table: what is measured, against what, and the bar that it shall keep.

All robots are built with the default configuration.
"""

from __future__ import annotations

import dataclasses
import itertools
import math
import os
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from support.corpus import REPOSITORY
from support.daemon import LIMIT, Watch

from benchmarks.measuring import Cost, Measurement, Pair, Reading, UnexpectedError, measure, run
from benchmarks.motors import Motors
from benchmarks.published import Published
from benchmarks.robots import (
    Source,
    mesh,
    mjcf_chain,
    sdf_chain,
    write_format_workspace,
    write_meshes,
    write_workspace,
    write_xacro_workspace,
)
from urdfsync.analysis.checks.cache import UserCache
from urdfsync.analysis.checks.libraries import copy_named, find_standard_library
from urdfsync.merge import merge

ARM = REPOSITORY / "modelica/UrdfSync/Resources/robots/six_axis_arm/six_axis_arm.urdf"
REFERENCE = 12.0
"""Milliseconds of `python -c pass` on the machine that bars in milliseconds are meant for."""
_ADDED = "Modelica.Blocks.Sources.Constant added(k = 1);"


@dataclasses.dataclass(frozen=True)
class Tools:
    """What all rows need."""

    folder: Path
    """An empty one."""
    scripts: Path
    """Folder of the console scripts `urdfsync` and `empty`, which does nothing, and of `python`."""
    published: Published | None

    def urdfsync(self, *arguments: str) -> list[str]:
        """A command."""
        return [str(self.scripts / "urdfsync"), *arguments]

    def empty(self) -> Cost:
        """Measure a console script that does nothing."""
        return measure([str(self.scripts / "empty")], self.folder)

    def python(self) -> Cost:
        """Measure a Python that does nothing."""
        return measure([str(self.scripts / "python"), "-c", "pass"], self.folder)


def ratio(at_most: float | None = None) -> Reading:
    """The ratio of wall-clock times."""
    return Reading(lambda mine, other: mine.wall / other.wall, at_most)


CPU = Reading(lambda mine, other: mine.cpu / other.cpu, what="CPU time")


def scaled(at_most: float) -> Reading:
    """Milliseconds, where the other takes `REFERENCE`."""
    return Reading(
        lambda mine, other: mine.wall / other.wall * REFERENCE, at_most, f"ms where that takes {REFERENCE:g}"
    )


def start(tools: Tools) -> Iterator[Pair]:
    """What needs neither a parser of arguments nor a library."""
    for option in ("--version", "--help"):
        mine = _command(tools.urdfsync(option), tools.folder, "urdfsync")
        yield Pair(option, mine, "python -c pass", tools.python, [ratio(2), CPU])


def nothing_to_do(tools: Tools) -> Iterator[Pair]:
    """A command where everything is in step, beside an empty console script."""
    places = [
        ("400 outputs", 1.2, write_workspace(tools.folder / "400", 1, 97)),
        ("8,000 outputs", 4, write_workspace(tools.folder / "8,000", 100, 17)),
        ("xacro with 40 included files", 1.6, write_xacro_workspace(tools.folder / "xacro", 40)),
    ]
    for title, bar, place in places:
        commands = {"build": tools.urdfsync("build"), "status": tools.urdfsync("status")}
        run(commands["build"], place)  # which says notes in full: the next ones count them
        time.sleep(2.1)  # no answer is saved while a file is younger
        for name, command in commands.items():
            run(command, place)
            what = f"{name}, {title}"
            yield Pair(
                what, _command(command, place, "in step"), "empty console script", tools.empty, [ratio(bar), CPU]
            )
        hook = tools.urdfsync("hook", "check")
        for arguments in (
            ["init", "-q"],
            ["add", "."],
            ["-c", "user.name=b", "-c", "user.email=b", "commit", "-qm", "all"],
        ):
            run(["git", *arguments], place)
        run(hook, place)
        what = f"pre-commit hook, {title}"
        yield Pair(what, _command(hook, place, ""), "empty console script", tools.empty, [ratio(6), CPU])


def one_mass_changed(tools: Tools) -> Iterator[Pair]:
    """A build by a process of its own after one mass has changed."""
    for links, bar, at_most in ((11, 8, 3.5), (100, 10, 1.7)):
        place = write_workspace(tools.folder / f"{links}", 1, links)
        mine = changed(tools, place)
        yield Pair(f"{links} links", mine, "python -c pass", tools.python, [ratio(bar), CPU])
        if tools.published:
            other = changed_by(tools.published, place / "robot0.urdf", tools.folder / f"published {links}")
            yield Pair(f"{links} links", mine, "published tool", other, [ratio(at_most), CPU])


def first_build(tools: Tools) -> Iterator[Pair]:
    """A build where nothing is built yet."""
    for links, bar in ((11, 3.5), (100, 1.6), (1000, 0.03)):
        if tools.published:
            place = write_workspace(tools.folder / f"{links}", 1, links)
            other = first_by(tools.published, place / "robot0.urdf", tools.folder / f"published {links}")
            readings = [ratio(bar), CPU]
            if links == 1000:
                readings.append(Reading(lambda mine, other: mine.peak / other.peak, 1.6, "peak memory"))
            yield Pair(f"{links:,} links", first(tools, place), "published tool", other, readings, links == 1000)
    arm = tools.folder / "arm"
    arm.mkdir()
    (arm / "urdfsync.toml").write_text(f'[robots.robot0]\nsource = "{ARM.as_posix()}"\npackage = "Robot0"\n')
    meshes = write_workspace(tools.folder / "meshes", 1, 11, mesh)
    write_meshes(meshes, 11)
    for what, place, bar in (
        ("six-axis arm, COLLADA among its meshes", arm, 60),
        ("11 links, STL and OBJ", meshes, 60),
    ):
        yield Pair(what, first(tools, place), "python -c pass", tools.python, [ratio(bar), CPU])


def formats(tools: Tools) -> Iterator[Pair]:
    """Builds of a robot in another format, beside the same robot as URDF."""
    cpu = dataclasses.replace(CPU, at_most=2.5)
    for suffix, text in (("xml", mjcf_chain("robot0", 11)), ("sdf", sdf_chain("robot0", 11))):
        mine = [write_format_workspace(tools.folder / suffix / kind, suffix, text) for kind in ("first", "changed")]
        other = [write_workspace(tools.folder / f"urdf beside {suffix}" / kind, 1, 11) for kind in ("first", "changed")]
        what = f"{'MJCF' if suffix == 'xml' else 'SDF'}, 11 links"
        yield Pair(f"{what}, first build", first(tools, mine[0]), "URDF", first(tools, other[0]), [cpu])
        yield Pair(f"{what}, one mass", changed(tools, mine[1]), "URDF", changed(tools, other[1]), [cpu])


def growth(tools: Tools) -> Iterator[Pair]:
    """The exponent with which CPU time grows, from 1,000 to 10,000 links."""
    few, many = (write_workspace(tools.folder / f"{links}", 1, links) for links in (1000, 10_000))
    exponent = Reading(lambda mine, other: math.log10(mine.cpu / other.cpu), 1.1, "exponent of CPU time")
    pair = ("10,000 links", first(tools, many), "1,000 links", first(tools, few), [exponent])
    yield Pair(*pair, is_slow=True)


def table(tools: Tools) -> Iterator[Pair]:
    """Builds of a table of 10,000 rows, beside rendering its texts and writing its files alone."""
    motors = Motors(tools.folder / "motors", 10_000)
    place, alone = motors.folder, motors.render_and_write()
    against, command = "rendering and writing alone", tools.urdfsync("build")

    def after(edit: Callable[[], None], expected: str) -> Measurement:
        def measurement() -> Cost:
            edit()
            os.sync()
            return measure(command, place, expected)

        return measurement

    def cpu(at_most: float) -> list[Reading]:
        return [dataclasses.replace(CPU, at_most=at_most)]

    yield Pair("first build", first(tools, place), against, alone, cpu(2), is_slow=True)
    yield Pair("one changed row", after(motors.change_row, "1 file written"), against, alone, cpu(2), is_slow=True)
    exchanged = after(motors.exchange_keys, "2 files written")
    yield Pair("exchanged keys", exchanged, against, alone, cpu(2), is_slow=True)
    run(command, place)  # remembers its result, once all files are older than two seconds
    time.sleep(2.1)
    yield Pair("nothing to do", _command(command, place, "in step"), against, alone, cpu(0.2), is_slow=True)


def daemon(tools: Tools) -> Iterator[Pair]:
    """One mass changed in the daemon, which does not wait for more events (`--settle 0`)."""
    for links, bar in ((11, 30), (133, 80), (1000, 500)):
        place = write_workspace(tools.folder / f"{links}", 1, links)
        with Watch(place, "--settle", "0", "--rescan", "3600") as watch:
            watch.rest()
            pair = (Edits(watch, place), "python -c pass", tools.python, [scaled(bar), CPU])
            yield Pair(f"{links:,} links", *pair)


def edited(tools: Tools) -> Iterator[Pair]:
    """One mass changed where the robot model is edited, beside one that nobody edited; alone and in the daemon."""
    for links in (100, 1000):
        places = [write_workspace(tools.folder / f"{kind} {links}", 1, links) for kind in ("edited", "untouched")]
        mine, other = (changed(tools, place) for place in places)
        _edit_model(places[0])
        yield Pair(f"{links:,} links, alone", mine, "not edited", other, [ratio(1.5), CPU])
        quick = ("--settle", "0", "--rescan", "3600")
        with Watch(places[0], *quick) as watch, Watch(places[1], *quick) as watch_other:
            watch.rest()
            watch_other.rest()
            pair = (Edits(watch, places[0]), "not edited", Edits(watch_other, places[1]))
            yield Pair(f"{links:,} links, in the daemon", *pair, [ratio(1.5), CPU])


def merged(tools: Tools) -> Iterator[Pair]:
    """The merge of a robot model to which a component was added with an export that has one more link."""
    texts = []
    for links in (1000, 1001):
        place = write_workspace(tools.folder / f"{links}", 1, links)
        run(tools.urdfsync("build", "--quiet"), place)
        texts.append((place / "modelica/Robot0/Robot0.mo").read_text(encoding="utf-8"))
    base, generated = texts
    mine = _with_component(base)

    def measurement() -> Cost:
        begin, used = time.perf_counter(), time.process_time()
        found = merge(base, mine, generated, is_modelica=True)
        cost = Cost(time.perf_counter() - begin, time.process_time() - used)
        if not found.text or "link1000" not in found.text or _ADDED not in found.text:
            raise UnexpectedError(f"the merge lacks a side: {found.contradictions} {found.flaw}")
        return cost

    yield Pair("1,000 links", measurement, "python -c pass", tools.python, [scaled(1000), CPU])


def check(tools: Tools) -> Iterator[Pair]:
    """A check whose answers are cached."""
    command = tools.urdfsync("check", "six_axis_arm", "--config", str(REPOSITORY / "urdfsync.toml"))
    yield Pair(
        "six-axis arm", _command(command, tools.folder, "six_axis_arm"), "python -c pass", tools.python, [ratio()]
    )


_DIRECT = """
import sys, rumoca
source = "model P\\n  import Modelica;\\n  import UrdfSync;\\n  import Arm;\\n  extends Arm.ArmTest;\\nend P;\\n"
model = rumoca.Session(roots=sys.argv[1:]).loads(source, model="P", filename="P.mo")
model.simulate((0, 5), config=rumoca.SimConfig(dt=0.02, rtol=1e-6, atol=1e-6))
"""


def simulate(tools: Tools) -> Iterator[Pair]:
    """From the command to the plot, beside compiling and integrating alone."""
    place = tools.folder / "arm"
    place.mkdir()
    (place / "arm.urdf").write_bytes(ARM.read_bytes())
    (place / "urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    run(tools.urdfsync("build", "--quiet"), place)
    texts = [file.read_bytes() for file in (place / "modelica").rglob("*.mo")]
    parts = {**find_standard_library(), "UrdfSync": REPOSITORY / "modelica/UrdfSync"}
    roots = [str(copy_named(parts, texts, UserCache.default())), str(place / "modelica/Arm")]
    direct = [str(tools.scripts / "python"), "-c", _DIRECT, *roots]
    stops = itertools.count(5.0, 1e-9)  # what was simulated before is not simulated again

    def measurement() -> Cost:
        command = tools.urdfsync("simulate", "--stop", repr(next(stops)), "--plot", "arm.png")
        return measure(command, place, "plot: arm.png")

    more = Reading(lambda mine, other: mine.wall - other.wall, 1.0, "s more than that")
    compiler = "compiling and integrating alone"
    yield Pair(
        "six-axis arm, 5 s, with a plot", measurement, compiler, lambda: measure(direct, place), [more], is_slow=True
    )


TABLES = {
    "start": ("start", start),
    "noop": ("nothing to do", nothing_to_do),
    "change": ("one mass changed, whole process", one_mass_changed),
    "build": ("first build", first_build),
    "watch": ("one mass changed in the daemon", daemon),
    "edited": ("one mass changed, robot model edited", edited),
    "merge": ("merge of an edited robot model, one link more", merged),
    "formats": ("another format", formats),
    "growth": ("growth of a first build", growth),
    "table": ("table of 10,000 rows", table),
    "check": ("check with warm caches", check),
    "simulate": ("simulation", simulate),
}


def first(tools: Tools, folder: Path) -> Measurement:
    """A first build of the only robot of a folder."""

    def measurement() -> Cost:
        for name in ("modelica", ".urdfsync"):
            put_aside(folder / name)
        os.sync()
        cost = measure(tools.urdfsync("build"), folder, "files written")
        if not (folder / "modelica/Robot0/package.mo").is_file():
            raise UnexpectedError(f"the robot of {folder} is not built")
        return cost

    return measurement


def changed(tools: Tools, folder: Path) -> Measurement:
    """A build after the mass of one link has changed; the folder is built before."""
    run(tools.urdfsync("build", "--quiet"), folder)
    source = Source(next(folder.glob("robot0.*")))

    def measurement() -> Cost:
        mass = source.edit()
        os.sync()
        cost = measure(tools.urdfsync("build"), folder, "written")
        _require_mass(folder, mass)
        return cost

    return measurement


def first_by(published: Published, source: Path, folder: Path) -> Measurement:
    """A first build by the published tool, in a folder of its own."""

    def measurement() -> Cost:
        put_aside(folder)
        os.sync()
        return published.build(source, folder)

    return measurement


def changed_by(published: Published, original: Path, folder: Path) -> Measurement:
    """An update by the published tool after the mass of one link has changed, in a folder of its own."""
    folder.mkdir()
    source = Source(folder / original.name)
    source.path.write_bytes(original.read_bytes())
    published.build(source.path, folder / "out")

    def measurement() -> Cost:
        mass = source.edit()
        os.sync()
        return published.update(source.path, folder / "out", mass)

    return measurement


class Edits:
    """A daemon and the robot that it watches; each call changes a mass, and measures until it is told to be built."""

    def __init__(self, watch: Watch, folder: Path) -> None:
        self._watch, self._folder, self._source = watch, folder, Source(folder / "robot0.urdf")

    def __call__(self) -> Cost:
        """Return the time from the edit to the daemon's event `built`, and its CPU time meanwhile."""
        pid, since = self._watch.process.pid, self._watch.mark
        self._rest(pid)
        used = _cpu(pid)
        mass = self._source.edit()
        begin = time.perf_counter()
        self._watch.wait("built", lambda event: bool(event["files"]), since)
        wall = time.perf_counter() - begin
        _require_mass(self._folder, mass)
        self._rest(pid)
        return Cost(wall, _cpu(pid) - used)

    def _rest(self, pid: int) -> None:
        """Wait until the daemon uses no more processor time."""
        end, used = time.monotonic() + LIMIT, -1.0
        while used != (used := _cpu(pid)):
            if time.monotonic() > end:
                raise TimeoutError("the daemon does not come to rest")
            time.sleep(0.3)


def put_aside(path: Path) -> None:
    """Move a folder away, if it is there. It is not deleted: ext4 makes files slowly where many have just gone."""
    if path.exists():
        path.rename(Path(tempfile.mkdtemp(prefix="old-", dir=path.parent.parent)) / path.name)


def _edit_model(folder: Path) -> None:
    """Add a component to the robot model, as a user does; the folder is built before."""
    model = folder / "modelica/Robot0/Robot0.mo"
    model.write_text(_with_component(model.read_text(encoding="utf-8")), encoding="utf-8")


def _with_component(text: str) -> str:
    changed = text.replace("\nequation\n", f"\n  {_ADDED}\n\nequation\n", 1)
    if changed == text:
        raise UnexpectedError("the model has no equations")
    return changed


def _command(command: list[str], folder: Path, expected: str) -> Measurement:
    return lambda: measure(command, folder, expected)


def _require_mass(folder: Path, mass: str) -> None:
    records = (folder / "modelica/Robot0/Links").glob("*Parameters.mo")
    if not any(f"mass = {mass}," in record.read_text(encoding="utf-8") for record in records):
        raise UnexpectedError(f"no record of {folder} has the mass {mass}")


def _cpu(pid: int) -> float:
    """Seconds that a process has run, with threads that have ended: its clock, as `clock_getcpuclockid` names it."""
    return time.clock_gettime((~pid << 3) | 2)
