"""Other build tools, each with something built by which it has nothing to do."""

from __future__ import annotations

import dataclasses
import shutil
from collections.abc import Iterator, Sequence
from pathlib import Path

from benchmarks.measuring import Cost, measure, run
from benchmarks.tools import Tools


@dataclasses.dataclass(frozen=True)
class Peer:
    """A tool that has nothing to do."""

    name: str
    command: Sequence[str]
    folder: Path
    said: str
    """Which is how it says so."""

    def __call__(self) -> Cost:
        """Measure it."""
        return measure(self.command, self.folder, self.said)


def peers(tools: Tools, workspace: Path) -> Iterator[Peer]:
    """The tools that are there, with copies of a built workspace: each output is made from its robot's source."""
    for name, arguments, write, said in (
        ("ninja", [], _write_ninja, "no work to do"),
        ("doit", [], _write_doit, "-- build:"),
        ("dvc", ["status"], _write_dvc, "up to date"),
    ):
        program = tools.program(name)
        if program is None:
            continue
        target = tools.folder / name
        shutil.copytree(workspace, target, ignore=shutil.ignore_patterns(".git", ".urdfsync"))
        outputs = sorted(file.relative_to(target).as_posix() for file in (target / "modelica").rglob("*.*"))
        write(target, outputs, program)
        yield Peer(" ".join([name, *arguments]), [program, *arguments], target, said)


def _source(output: str) -> str:
    """The source of an output: its second folder is the package, which is called as the robot."""
    return f"{output.split('/')[1].lower()}.urdf"


def _write_ninja(folder: Path, outputs: Sequence[str], program: str) -> None:
    builds = "".join(f"build {output}: touch {_source(output)}\n" for output in outputs)
    (folder / "build.ninja").write_text(f"rule touch\n  command = touch $out\n{builds}")
    run([program], folder)


def _write_doit(folder: Path, outputs: Sequence[str], program: str) -> None:
    tasks = [{"name": output, "file_dep": [_source(output)], "targets": [output]} for output in outputs]
    (folder / "dodo.py").write_text(
        f"def task_build():\n    for task in {tasks!r}:\n        yield {{**task, 'actions': [lambda: None]}}\n"
    )
    run([program], folder)


def _write_dvc(folder: Path, outputs: Sequence[str], program: str) -> None:
    packages = sorted({output.split("/")[1] for output in outputs})
    stages = "".join(
        f"  {package}:\n    cmd: echo\n    deps: [{package.lower()}.urdf]\n"
        f"    outs:\n    - modelica/{package}:\n        persist: true\n"
        for package in packages
    )
    (folder / "dvc.yaml").write_text(f"stages:\n{stages}")
    run([program, "init", "-q", "--no-scm"], folder)
    for key in ("core.analytics", "core.check_update"):
        run([program, "config", key, "false"], folder)
    run([program, "repro", "-q"], folder)
