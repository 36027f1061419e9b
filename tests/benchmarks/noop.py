"""A command that has nothing to do, beside an empty console script, other build tools and `git status`.

Two workspaces: one robot with about 400 outputs, and 100 robots with about 8,000 together. Build tools that are there
get the same outputs, each made from its robot's source. The empty console script is installed beside `urdfsync`, in
an environment of its own that sees what this one has.
"""

from __future__ import annotations

import base64
import hashlib
import os
import shutil
import subprocess
import sys
import time
import venv
import zipfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from support.corpus import REPOSITORY
from support.timing import Row, seconds

EMPTY, GIT = "empty console script", "git status"
ONE, MANY = "400 outputs", "8,000 outputs"

_ENTRIES = {"empty": "benchmark:main", "urdfsync": "urdfsync.__main__:main", "urdfsync-hook": "urdfsync.hook:main"}
_LINK = """\
<link name="link{0}"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
  <visual><geometry><box size="1 1 1"/></geometry></visual></link>
"""
_JOINT = """\
<joint name="joint{0}" type="revolute"><parent link="link{1}"/><child link="link{0}"/><axis xyz="0 0 1"/>
  <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
"""
_PATIENCE = 60.0
"""Seconds to wait for a stamp."""


def rows(labels: Sequence[str]) -> list[Row]:
    """What is compared with what, as far as it was measured."""
    wanted = [
        *(Row(f"{command}, {ONE}", EMPTY, 1.3) for command in ("build", "build --check", "status")),
        Row(f"hook, {ONE}", EMPTY, None),
        Row(f"build, {ONE}", f"doit, {ONE}", 0.2),
        Row(f"build, {ONE}", f"dvc status, {ONE}", 0.05),
        Row(f"build, {ONE}", f"ninja, {ONE}", None),
        Row(f"build, {MANY}", EMPTY, 3.0),
        Row(f"build, {MANY}", f"{GIT}, {MANY}", 3.0),
        Row(f"build without a stamp, {ONE}", EMPTY, None),
        Row(f"build without a stamp, {MANY}", EMPTY, None),
    ]
    return [row for row in wanted if {row.what, row.against} <= set(labels)]


def prepare(folder: Path, peers: Path | None) -> Mapping[str, Callable[[], float]]:
    """What makes each measurement, in seconds, by its label; `peers` is where the other tools are."""
    scripts = _environment(folder / "environment")
    found: dict[str, Callable[[], float]] = {EMPTY: lambda: seconds([str(scripts / "empty")], folder)}
    for label, robots, links in ((ONE, 1, 97), (MANY, 100, 17)):
        place = _workspace(folder / f"{robots}", robots, links, scripts)
        program = str(scripts / "urdfsync")
        for command in (["build"], ["build", "--check"], ["status"]):
            found[f"{' '.join(command)}, {label}"] = _timed([program, *command], place)
        found[f"hook, {label}"] = _timed([str(scripts / "urdfsync-hook"), "check"], place)
        found[f"build without a stamp, {label}"] = _unstamped([program, "build"], place)
        found[f"{GIT}, {label}"] = _timed(["git", "status"], place)
    for name, command, peer in _peers(folder / "peers", folder / "1", peers):
        found[f"{name}, {ONE}"] = _timed(command, peer)
    return found


def _timed(command: Sequence[str], folder: Path) -> Callable[[], float]:
    return lambda: seconds(command, folder, _variables())


def _unstamped(command: Sequence[str], folder: Path) -> Callable[[], float]:
    """The full decision; the stamp is brought back afterwards, and is as good as before."""
    stamp = folder / ".urdfsync/stamp"

    def measure() -> float:
        stamp.rename(stamp.with_name("kept"))
        took = seconds(command, folder, _variables())
        stamp.with_name("kept").replace(stamp)
        return took

    return measure


def _variables() -> dict[str, str]:
    return {name: value for name, value in os.environ.items() if not name.startswith(("GIT_", "PYTHON"))}


def _environment(folder: Path) -> Path:
    """An environment with an empty console script and those of urdfsync; returns the folder of the scripts."""
    venv.create(folder, symlinks=os.name != "nt")
    scripts = folder / ("Scripts" if os.name == "nt" else "bin")
    wheel = folder / "benchmark-1-py3-none-any.whl"
    _write_wheel(wheel)
    python = str(scripts / "python")
    command = [sys.executable, "-m", "pip", "-q", "--python", python, "install", "--no-deps", "--no-index", str(wheel)]
    subprocess.run(command, check=True, env=_variables())
    asked = [python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"]
    site = Path(subprocess.run(asked, check=True, capture_output=True, text=True).stdout.strip())
    libraries = [str(REPOSITORY), *(path for path in sys.path if path.endswith("-packages"))]
    (site / "benchmark.pth").write_text("\n".join(libraries) + "\n")
    return scripts


def _write_wheel(file: Path) -> None:
    scripts = "".join(f"{name} = {place}\n" for name, place in _ENTRIES.items())
    tags = "Root-Is-Purelib: true\nTag: py3-none-any"
    contents = {
        "benchmark.py": "def main():\n    return 0\n",
        "benchmark-1.dist-info/METADATA": "Metadata-Version: 2.1\nName: benchmark\nVersion: 1\n",
        "benchmark-1.dist-info/WHEEL": f"Wheel-Version: 1.0\nGenerator: by hand\n{tags}\n",
        "benchmark-1.dist-info/entry_points.txt": f"[console_scripts]\n{scripts}",
    }
    record = [f"{name},sha256={_digest(text)},{len(text)}" for name, text in contents.items()]
    contents["benchmark-1.dist-info/RECORD"] = "\n".join([*record, "benchmark-1.dist-info/RECORD,,"]) + "\n"
    with zipfile.ZipFile(file, "w") as archive:
        for name, text in contents.items():
            archive.writestr(name, text)


def _digest(text: str) -> str:
    return base64.urlsafe_b64encode(hashlib.sha256(text.encode()).digest()).decode().rstrip("=")


def _workspace(folder: Path, robots: int, links: int, scripts: Path) -> Path:
    """Robots that are built, committed and stamped."""
    folder.mkdir()
    text = "".join(_LINK.format(n) for n in range(links)) + "".join(_JOINT.format(n, n - 1) for n in range(1, links))
    tables = ["[defaults]\ncross_check = false\n"]
    for number in range(robots):
        (folder / f"robot{number}.urdf").write_text(f'<robot name="robot{number}">{text}</robot>')
        tables.append(f'[robots.robot{number}]\nsource = "robot{number}.urdf"\npackage = "Robot{number}"\n')
    (folder / "urdfsync.toml").write_text("".join(tables))
    _run([str(scripts / "urdfsync"), "build", "--quiet"], folder)
    _commit(folder)
    end = time.monotonic() + _PATIENCE
    stamp, size = folder / ".urdfsync/stamp", -1
    while size != (size := stamp.stat().st_size if stamp.exists() else -1) or size < 0:
        if time.monotonic() > end:
            raise TimeoutError(f"no stamp in {folder}")
        for command in (["build"], ["build", "--check"], ["status"]):
            _run([str(scripts / "urdfsync"), *command], folder)
        _run([str(scripts / "urdfsync-hook"), "check"], folder)
        time.sleep(0.1)
    return folder


def _commit(folder: Path) -> None:
    for command in (
        ["init", "-q"],
        ["add", "."],
        ["-c", "user.name=b", "-c", "user.email=b@c", "commit", "-qm", "all"],
        ["status"],
    ):
        _run(["git", *command], folder)


def _peers(folder: Path, place: Path, peers: Path | None) -> Iterator[tuple[str, list[str], Path]]:
    """The other tools that are there: name, command, and the folder in which it has nothing to do."""
    path = os.pathsep.join(filter(None, [str(peers or ""), os.environ.get("PATH", "")]))
    for name, command, write in (
        ("ninja", ["ninja"], _write_ninja),
        ("doit", ["doit"], _write_doit),
        ("dvc status", ["dvc", "status"], _write_dvc),
    ):
        program = shutil.which(command[0], path=path)
        if program is None:
            continue
        target = folder / command[0]
        shutil.copytree(place, target, ignore=shutil.ignore_patterns(".git", ".urdfsync"))
        outputs = sorted(file.relative_to(target).as_posix() for file in (target / "modelica").rglob("*.*"))
        write(target, outputs, program)
        yield name, [program, *command[1:]], target


def _source(output: str) -> str:
    """The source of an output: its second folder is the package, which is called as the robot."""
    return f"{output.split('/')[1].lower()}.urdf"


def _write_ninja(folder: Path, outputs: Sequence[str], program: str) -> None:
    builds = "".join(f"build {output}: touch {_source(output)}\n" for output in outputs)
    (folder / "build.ninja").write_text(f"rule touch\n  command = touch $out\n{builds}")
    _run([program], folder)


def _write_doit(folder: Path, outputs: Sequence[str], program: str) -> None:
    tasks = [{"name": output, "file_dep": [_source(output)], "targets": [output]} for output in outputs]
    (folder / "dodo.py").write_text(
        f"def task_build():\n    for task in {tasks!r}:\n        yield {{**task, 'actions': [lambda: None]}}\n"
    )
    _run([program], folder)


def _write_dvc(folder: Path, outputs: Sequence[str], program: str) -> None:
    packages = sorted({output.split("/")[1] for output in outputs})
    stages = "".join(
        f"  {package}:\n    cmd: echo\n    deps: [{package.lower()}.urdf]\n"
        f"    outs:\n    - modelica/{package}:\n        persist: true\n"
        for package in packages
    )
    (folder / "dvc.yaml").write_text(f"stages:\n{stages}")
    _run([program, "init", "-q", "--no-scm"], folder)
    _run([program, "repro", "-q"], folder)


def _run(command: Sequence[str], folder: Path) -> None:
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL, env=_variables())
