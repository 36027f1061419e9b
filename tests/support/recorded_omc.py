"""Conversations with OpenModelica, which are recorded once, and replayed where OpenModelica is missing.

A folder below `tests/modelica/omc` has the calls (`script.mos`, without the folders of files), the answers (`stdout`),
and the results of simulations (`task0_0.csv` and so on).
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
"""The folder for new conversations, in tests that have OpenModelica; without it, tests replay recorded ones."""
VERSION = '"v1.27.0-dev-ea251558-rust"\n""\n'
_PROGRAM = f"#!{sys.executable}\nimport sys\nsys.path.insert(0, {str(REPOSITORY / 'tests')!r})\n"
_PROGRAM += "from support import recorded_omc\nrecorded_omc.answer({name!r})\n"
_NO_NETWORK = re.compile(r"Error: (?:Curl error|Failed to download)[^\n]*\n")
_TEE = '#!/bin/sh\ncp "$1" "{folder}/script.mos"\n"{omc}" "$1" | tee "{folder}/stdout"\n'


def install(name: str, folder: Path) -> None:
    """Write a program `omc` into a folder that replays a conversation, or records a new one."""
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
    """Write the results of the first run of each task beside the new conversation."""
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
    """Replace `omc SCRIPT.mos`: end with an error unless the script equals the recorded one."""
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
