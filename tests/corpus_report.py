"""Compiles and simulates every robot of the corpus, the largest included, and prints a table of times and memory.

`python tests/corpus_report.py [NAME …]` takes robots whose path contains a NAME, all without any. One robot
at a time, each in processes of its own; the largest take minutes. Results are those of
`tests/modelica/test_compile.py` and `test_physics.py`.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from conftest import find_library
from support import amended, corpus, physics
from support.modelica import Outcome, compile_task, execute
from support.packages import generate, proposed_base, read

from urdfsync.domain import Target

BOT = Target("Bot", "Bot")
HEADER = (
    "robot",
    "links",
    "moving",
    "axes",
    "base",
    "robot s",
    "Run s",
    "Test s",
    "MB",
    "physics s",
    "MB",
    "worst error",
    "note",
)


def main(names: list[str]) -> int:
    """One row per robot, as soon as it is known; 1 if anything failed."""
    library = find_library()
    if library is None or corpus.robots() == (corpus.ABSENT,):
        print("needs the corpus and the Modelica Standard Library: set URDFSYNC_CORPUS and MODELICAPATH")  # noqa: T201
        return 2
    chosen = [file for file in corpus.robots() if not names or any(name in file for name in names)]
    print("| " + " | ".join(HEADER) + " |\n|" + " --- |" * len(HEADER))  # noqa: T201
    failed = False
    for file in chosen:
        row, good = report(file, library)
        failed |= not good
        print(f"| {' | '.join(row)} |", flush=True)  # noqa: T201
    return int(failed)


def report(file: str, library: Path) -> tuple[list[str], bool]:
    """The cells of a robot's row, and whether all went well."""
    content = (corpus.FOLDER / file).read_bytes()
    reading = read(content, file)
    name = corpus.label(file)
    if reading.snapshot is None:
        return [name, *[""] * (len(HEADER) - 2), "; ".join(d.code for d in reading.diagnostics)], True
    base = proposed_base(content)
    package = generate(corpus.FOLDER / file, BOT, base=base)
    joints = package.skeleton.joints
    counts = [len(package.skeleton.links), corpus.moving_joints()[file], len(physics.driven_axes(package))]
    with tempfile.TemporaryDirectory() as folder:
        tasks = [compile_task(f"Bot.Bot{suffix}") for suffix in ("", "Run", "Test")]
        compiled = execute(library, [package.write(Path(folder))], tasks)
    errors = [outcome.error for outcome in compiled if outcome.error]
    moved, notes = _physics(content, library) if joints else (["", "", ""], [])
    cells = [name, *map(str, counts), base, *_times(compiled), *moved, "; ".join([*notes, *errors])]
    return cells, not errors and not any(note.startswith("disagrees") for note in notes)


def _times(outcomes: list[Outcome]) -> list[str]:
    return [*(f"{outcome.seconds:.1f}" for outcome in outcomes), f"{max(o.megabytes for o in outcomes):.0f}"]


def _physics(content: bytes, library: Path) -> tuple[list[str], list[str]]:
    urdf, notes = amended.acceptable(content), []
    if urdf != content:
        notes.append("amended")
    if amended.lacks_inertia(urdf):
        urdf = amended.with_inertias(urdf)
        notes.append("synthetic inertias")
    package = generate(urdf, BOT)
    reference = physics.Reference(urdf.decode(), package)
    with tempfile.TemporaryDirectory() as folder:
        motion = physics.random_motion(len(reference.axes))
        errors, outcome = physics.measure(library, package.write(Path(folder)), reference, motion)
    if errors.worst() > physics.TOLERANCE:
        notes.append(f"disagrees: {errors}")
    return [f"{outcome.seconds:.1f}", f"{outcome.megabytes:.0f}", f"{errors.worst():.0e}"], notes


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
