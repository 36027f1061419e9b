"""urdfsync notices each change of its own program; nobody has to raise a number.

One line of a template, of the reader or of the model is changed in a copy of the program, so that a text changes. Every
verdict changes with the program, although the source, the package and the recorded state stay unchanged.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from support.cases import sampled
from support.git import NEEDS_GIT, Repository
from support.networks import edit
from support.urdfs import ELBOW_ARM

from urdfsync.common.version import __version__

ROOT = Path(__file__).parents[1]
CHANGES = {
    "template": ("templates/urdf/link/record.mo.jinja", '("Numbers of " ~ title)', '("All numbers of " ~ title)'),
    "reader": (
        "urdfsync/formats/urdf/parse/elements.py",
        "        inertial = reader.read(part, place, Inertial, owner)\n",
        "        inertial = None\n",
    ),
    "model": ("urdfsync/formats/urdf/model/joint.py", "{joint.type} joint", "the {joint.type} joint"),
}
"""A file of the program, one of its lines, and the new line."""


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the program."""
    folder = tmp_path_factory.mktemp("program")
    for name in ("urdfsync", "templates", "modelica", "docs"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    return folder


def run(program: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": str(program), "PYTHONSAFEPATH": "1"}
    command = [sys.executable, "-m", "urdfsync", *arguments]
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False)


def call(program: Path, *arguments: str) -> int:
    return run(program, *arguments).returncode


@NEEDS_GIT
@pytest.mark.slow
@pytest.mark.parametrize("part", sampled(CHANGES, len(CHANGES)))
def test_every_verdict_sees_a_changed_line(
    program: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, part: str
) -> None:
    repository = Repository(tmp_path / "project", monkeypatch)
    monkeypatch.chdir(repository.folder)
    Path("arm.urdf").write_text(ELBOW_ARM)
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    assert call(program, "build") == 0
    repository.commit()
    verdicts = (["status"], ["build", "--check"], ["hook", "check"])
    assert [call(program, *command) for command in verdicts] == [0, 0, 0]
    name, old, new = CHANGES[part]
    before = (program / name).read_text()
    edit(program / name, old, new)
    try:
        assert [call(program, *command) for command in verdicts] == [1, 1, 1]
        assert call(program, "build") == 0
        assert call(program, "build", "--check") == 0
    finally:
        (program / name).write_text(before)
    assert call(program, "build", "--check") == 1


@pytest.mark.slow
def test_edits_follow_when_the_program_gives_an_element_another_identifier(
    program: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("arm.urdf").write_text(ELBOW_ARM.replace('"fore"', '"fore arm"').replace('"base"', '"the base"'))
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    assert call(program, "build") == 0
    links, robot = Path("modelica/Arm/Links"), Path("modelica/Arm/Arm.mo")
    (old,) = (path.stem for path in links.glob("Fore_arm_??????.mo"))
    component = f"f{old[1:]}"
    edit(links / f"{old}.mo", "\nequation", "\n  Real mine = m;\n\nequation")
    edit(robot, "\nequation", f"\n  Real mine = {component}.m;\n\nequation")
    edit(program / "urdfsync/modelica/identifiers.py", "_DIGITS = 6\n", "_DIGITS = 7\n")
    try:
        assert call(program, "build", "--quiet") == 0
        assert call(program, "build", "--check") == 0
    finally:
        edit(program / "urdfsync/modelica/identifiers.py", "_DIGITS = 7\n", "_DIGITS = 6\n")
    (new,) = (path.stem for path in links.glob("Fore_arm_???????.mo"))
    assert new.startswith(old)
    assert "Real mine = m;" in (links / f"{new}.mo").read_text()
    assert f"Real mine = f{new[1:]}.m;" in robot.read_text()
    assert len([*links.iterdir()]) == 6, "no orphans: two models, two records, package.mo and its order"


@NEEDS_GIT
@pytest.mark.slow
def test_two_versions_in_a_team(program: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The new version brings edits along and asks where it must; the old one writes nothing any more, and says why."""
    repository = Repository(tmp_path / "project", monkeypatch)
    monkeypatch.chdir(repository.folder)
    Path("arm.urdf").write_text(ELBOW_ARM)
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    assert call(ROOT, "build") == 0
    links = Path("modelica/Arm/Links")
    edit(links / "Fore.mo", "\nequation", "\n  Real mine = m;\n\nequation")
    edit(links / "ForeParameters.mo", "2.5", "2.6")
    assert call(ROOT, "build", "--check") == 0
    repository.commit()
    name, old, new = CHANGES["template"]
    newer = {program / "urdfsync/common/version.py": (f'"{__version__}"', '"9.0.0"'), program / name: (old, new)}
    for file, words in newer.items():
        edit(file, *words)
    try:
        assert call(program, "build", "--check") == 3, "both changed the record"
        assert call(program, "build") == 3
        assert call(program, "resolve", "--all", "--merge") == 0
        repository.commit()
        files = {file: file.read_bytes() for file in Path().rglob("*") if file.is_file() and ".git" not in file.parts}
        edit(Path("arm.urdf"), 'effort="5"', 'effort="6"')
        for command in (["build"], ["build", "--check"], ["status"], ["hook", "check"], ["resolve", "--all", "--take"]):
            refused = run(ROOT, *command)
            assert refused.returncode == 2, command
            told = f"urdfsync 9.0.0 wrote this state, and this is {__version__}, which is older; update urdfsync"
            assert told in refused.stderr
        edit(Path("arm.urdf"), 'effort="6"', 'effort="5"')
        assert all(file.read_bytes() == content for file, content in files.items() if "deps" not in file.parts)
        assert call(program, "build", "--check") == 0
    finally:
        for file, (before, after) in newer.items():
            edit(file, after, before)
    text = (links / "ForeParameters.mo").read_text()
    assert "All numbers of" in text
    assert "2.6" in text
    assert "Real mine = m;" in (links / "Fore.mo").read_text()
