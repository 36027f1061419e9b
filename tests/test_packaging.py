"""The users' installation: a complete wheel, which builds a robot.

`tools/try_installation.py` installs the wheel with its requirements, and `.ci/run` the project itself.
"""

from __future__ import annotations

import email
import json
import os
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest
from build import ProjectBuilder
from build.env import DefaultIsolatedEnv
from pyproject_hooks import quiet_subprocess_runner

REPOSITORY = Path(__file__).parents[1]

pytestmark = pytest.mark.slow


def tracked(*folders: str) -> set[str]:
    listing = subprocess.run(["git", "ls-files", *folders], cwd=REPOSITORY, check=True, capture_output=True, text=True)
    return set(listing.stdout.splitlines())


def test_wheel_and_sdist_are_complete(tmp_path: Path) -> None:
    """One test: the distributions are built once."""
    with DefaultIsolatedEnv() as environment:
        builder = ProjectBuilder.from_isolated_env(environment, REPOSITORY, runner=quiet_subprocess_runner)
        environment.install(builder.build_system_requires)
        for distribution in ("sdist", "wheel"):
            builder.build(distribution, tmp_path / "dist")
    names = sorted((tmp_path / "dist").iterdir())
    subprocess.run([sys.executable, "-m", "twine", "check", "--strict", *names], check=True)
    (wheel,), (sdist,) = (tmp_path.glob(f"dist/*.{ending}") for ending in ("whl", "tar.gz"))
    assert_wheel_carries_templates_and_library(wheel)
    assert_metadata_say_what_it_is(wheel)
    assert_sdist_carries_all_that_the_tests_need(sdist)
    assert_a_robot_is_built_from_what_the_wheel_has(wheel, tmp_path / "site")


def assert_wheel_carries_templates_and_library(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    assert names >= {f"urdfsync/_data/{name}" for name in tracked("templates", "modelica")}
    assert names >= tracked("urdfsync")
    assert "urdfsync/_data/docs/findings.md" in names
    assert not any(name.startswith(("tests/", "templates/", "modelica/")) for name in names)


def assert_metadata_say_what_it_is(wheel: Path) -> None:
    archive = zipfile.ZipFile(wheel)
    (name,) = (name for name in archive.namelist() if name.endswith("/METADATA"))
    metadata = email.message_from_bytes(archive.read(name))
    assert metadata["Description-Content-Type"] == "text/markdown"
    assert f"Programming Language :: Python :: {metadata['Requires-Python'][2:]}" in metadata.get_all("Classifier", [])


def assert_sdist_carries_all_that_the_tests_need(sdist: Path) -> None:
    with tarfile.open(sdist) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    assert names >= tracked(
        "urdfsync", "templates", "modelica", "tests", "tools", "docs", "urdfsync.toml", "LICENSE", "action.yml"
    )


def assert_a_robot_is_built_from_what_the_wheel_has(wheel: Path, site: Path) -> None:
    """The wheel is unpacked, as by an installer; it uses the packages of the tests."""
    zipfile.ZipFile(wheel).extractall(site)
    program = [sys.executable, "-P", "-c", "import sys; from urdfsync.__main__ import main; sys.exit(main())"]

    def urdfsync(*arguments: str | Path) -> str:
        command = [*program, *arguments]
        environment = {**os.environ, "PYTHONPATH": str(site)}
        return subprocess.run(command, cwd=site, env=environment, check=True, capture_output=True, text=True).stdout

    urdfsync("init", REPOSITORY / "modelica/UrdfSync/Resources/robots/six_axis_arm/six_axis_arm.urdf")
    assert "files written" in urdfsync("build")
    assert "in step" in urdfsync("build", "--check")
    library = Path(json.loads(urdfsync("library", "--format=json"))["results"][0]["folder"])
    assert library.is_relative_to(site)
    assert (library / "UrdfSync" / "package.mo").is_file()
