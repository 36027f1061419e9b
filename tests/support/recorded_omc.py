"""Conversations with OpenModelica, recorded from a real one and given again where there is none.

A folder below `tests/modelica/omc` has what was asked (`script.mos`, without the folders of files), what was answered
(`stdout`), and the results of the simulations (`task0_0.csv` and so on).
"""

from __future__ import annotations

import csv
import os
import re
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path

from support.corpus import REPOSITORY
from support.modelica import Series
from support.trajectories import write_trajectory

RECORDED = REPOSITORY / "tests/modelica/omc"
RECORDER = os.environ.get("URDFSYNC_RECORD")
"""A folder to write conversations to, in tests that have OpenModelica; without it, recorded ones are given again."""
VERSION = '"v1.27.0-dev-ea251558-rust"\n""\n'
_PROGRAM = f"#!{sys.executable}\nimport sys\nsys.path.insert(0, {str(REPOSITORY / 'tests')!r})\n"
_PROGRAM += "from support import recorded_omc\nrecorded_omc.answer({name!r})\n"
_NO_NETWORK = re.compile(r"Error: (?:Curl error|Failed to download)[^\n]*\n")
_TEE = '#!/bin/sh\ncp "$1" "{folder}/script.mos"\n"{omc}" "$1" | tee "{folder}/stdout"\n'


def install(name: str, folder: Path) -> None:
    """Write a program `omc` into a folder that answers as was recorded; or one that records what the real one says."""
    text = _PROGRAM.format(name=name)
    if RECORDER:
        place = Path(RECORDER, name)
        place.mkdir(parents=True)
        text = _TEE.format(folder=place, omc=shutil.which("omc"))
    folder.mkdir()
    program = folder / "omc"
    program.write_text(text)
    program.chmod(0o755)


def keep(name: str, runs: Sequence[Series]) -> None:
    """Write the results of the first run of each task beside the conversation that is recorded."""
    place = Path(RECORDER or "", name)
    for number, run in enumerate(runs):
        with (place / f"task{number}_0.csv").open("w", newline="") as file:
            table = csv.writer(file, lineterminator="\n")
            table.writerow(("time", *run.values))
            table.writerows(zip(run.times.tolist(), *(one.tolist() for one in run.values.values()), strict=True))
    for part in ("script.mos", "stdout"):
        text = (place / part).read_text()
        (place / part).write_text(_without_folders(_NO_NETWORK.sub("", text)))


def answer(name: str) -> None:
    """Stand for `omc SCRIPT.mos`: end with an error unless the script is what was asked when it was recorded."""
    script = _without_folders(Path(sys.argv[1]).read_text())
    if script.startswith("getVersion"):
        sys.stdout.write(VERSION)
        return
    if script != (RECORDED / name / "script.mos").read_text():
        sys.exit(f"not what was recorded: record {name} anew with OpenModelica and URDFSYNC_RECORD")
    for file in (RECORDED / name).glob("*.csv"):
        names, *rows = csv.reader(file.read_text().splitlines())
        columns = [tuple(map(float, column)) for column in zip(*rows, strict=True)]
        write_trajectory(Path(f"{file.stem}_res.mat"), {}, dict(zip(names, columns, strict=True)))
    sys.stdout.write((RECORDED / name / "stdout").read_text())


def _without_folders(script: str) -> str:
    return re.sub(r'"/[^"]*/([^"/]*)"', r'"\1"', script)
