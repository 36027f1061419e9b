"""The action for GitHub and the snippet for GitLab: valid, and their shells run."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml
from support import hostile
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.networks import edit
from support.schemas import validate

from urdfsync.engine.result import Exit

REPOSITORY = Path(__file__).parents[1]
PAGE = (REPOSITORY / "docs/git.md").read_text(encoding="utf-8")
ARM = '<robot name="arm"><link name="base"><inertial><mass value="1"/></inertial></link></robot>'
URDFSYNC = str(Path(sys.executable).with_name("urdfsync"))


def load(text: str) -> Any:
    return yaml.load(text, yaml.BaseLoader)  # which reads `on` as a word


ACTION = load((REPOSITORY / "action.yml").read_text(encoding="utf-8"))
INSTALL, REPORT = ACTION["runs"]["steps"][1:]
WORKFLOW, PIPELINE = map(load, re.findall(r"```yaml\n((?:on|models):.*?)```", PAGE, re.DOTALL))

posix = pytest.mark.skipif(shutil.which("bash") is None or sys.platform == "win32", reason="no bash")


@pytest.mark.parametrize(
    ("document", "schema"),
    [(ACTION, "github-actions"), (WORKFLOW, "github-workflows"), (PIPELINE, "gitlab-ci")],
    ids=["action", "workflow", "pipeline"],
)
def test_they_are_valid(document: Any, schema: str) -> None:
    validate(document, schema)


def test_the_workflow_uses_inputs_and_outputs_of_the_action() -> None:
    (step,) = [step for step in WORKFLOW["jobs"]["models"]["steps"] if step.get("id") == "urdfsync"]
    assert step["with"].keys() <= ACTION["inputs"].keys()
    assert set(re.findall(r"steps\.urdfsync\.outputs\.(\w+)", PAGE)) <= ACTION["outputs"].keys()
    names = re.findall(r"inputs\.(\S+) ", json.dumps(ACTION["runs"]))
    assert sorted(names) == sorted(ACTION["inputs"])


@pytest.fixture
def arm(folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> Repository:
    """A repository with a built arm; the last commit changes a mass only in the source."""
    repository = Repository(folder, monkeypatch)
    Path("arm.urdf").write_text(ARM)
    execute("init", "arm.urdf", "-q")
    execute("build", "-q")
    repository.commit()
    edit("arm.urdf", '"1"', '"2"')
    repository.commit()
    return repository


def run(script: str, **variables: str) -> int:
    shell = ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", script]
    return subprocess.run(shell, env={**os.environ, **variables}, check=False).returncode


def report(**inputs: str) -> tuple[int, dict[str, str]]:
    """Run the reporting step of the action; return exit code and outputs."""
    place = Path("runner")
    place.mkdir(exist_ok=True)
    files = {"GITHUB_STEP_SUMMARY": str(place / "summary"), "GITHUB_OUTPUT": str(place / "output")}
    given = dict.fromkeys(REPORT["env"], "") | inputs
    code = run(REPORT["run"], URDFSYNC=URDFSYNC, RUNNER_TEMP=str(place), **files, **given)
    return code, dict(line.split("=", 1) for line in Path(files["GITHUB_OUTPUT"]).read_text().splitlines())


@pytest.mark.slow
@posix
@NEEDS_GIT
def test_the_action_reports_what_changed_and_that_the_package_is_out_of_step(arm: Repository) -> None:
    code, outputs = report(AGAINST="HEAD~1")
    assert code == Exit.OUT_OF_STEP
    summary = Path("runner/summary").read_text(encoding="utf-8")
    assert summary == Path(outputs["comment"]).read_text(encoding="utf-8")
    assert summary.startswith("<h3>! arm: 1 file to write")
    assert "since HEAD~1" in summary
    log = json.loads(Path(outputs["sarif"]).read_text())
    validate(log, "sarif")
    assert "out-of-step" in {result["ruleId"] for result in log["runs"][0]["results"]}


@pytest.mark.slow
@posix
@NEEDS_GIT
def test_the_action_passes_if_all_is_in_step_though_the_sources_differ(arm: Repository, execute: Execute) -> None:
    execute("build", "-q")
    assert report(AGAINST="HEAD~1", ROBOTS="arm arm", CONFIG="urdfsync.toml")[0] == Exit.IN_STEP
    assert report(ROBOTS="arm\nother")[0] == Exit.ERROR


@posix
@NEEDS_GIT
def test_the_action_fails_if_there_is_nothing_to_compare_with_and_runs_no_input(arm: Repository) -> None:
    assert report(AGAINST="$(touch hacked)", ROBOTS="arm; touch hacked")[0] == Exit.ERROR
    assert not Path("hacked").exists()


@posix
@NEEDS_GIT
def test_the_pipeline_comments_and_fails_if_the_package_is_out_of_step(arm: Repository) -> None:
    tools = Path("tools")
    tools.mkdir()
    scripts = {"pip": "exit 0", "mktemp": "echo comment", "curl": 'printf "%s\\n" "$@" > posted'}
    for name, script in {**scripts, "urdfsync": f'{URDFSYNC} "$@"'}.items():
        (tools / name).write_text(f"#!/bin/sh\n{script}\n")
        (tools / name).chmod(0o755)
    variables = {"CI_API_V4_URL": "https://host/api", "CI_PROJECT_ID": "7", "CI_MERGE_REQUEST_IID": "3"}
    variables |= {"URDFSYNC_TOKEN": "secret", "URDFSYNC_ADDRESS": "x", "CI_MERGE_REQUEST_DIFF_BASE_SHA": "HEAD~1"}
    script = "\n".join(PIPELINE["models"]["script"])
    assert run(script, PATH=f"{tools.resolve()}:{os.environ['PATH']}", **variables) == Exit.OUT_OF_STEP
    assert "https://host/api/projects/7/merge_requests/3/notes" in Path("posted").read_text().splitlines()
    assert "body@comment" in Path("posted").read_text().splitlines()
    comment = Path("comment").read_text(encoding="utf-8")
    assert comment.index("since HEAD") < comment.index("! arm")


# What a pull request checks out


INERTIA = '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
ARMS = f"""<robot name="arm">
<link name="base"><inertial><mass value="1"/>{INERTIA}</inertial></link>

<link name="tip"><inertial><mass value="5"/>{INERTIA}</inertial></link>
<joint name="elbow" type="fixed"><parent link="base"/><child link="tip"/></joint>
</robot>
"""


@pytest.fixture
def pull_request(folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> Repository:
    """A repository with two branches, each with a changed mass and its package, and the host's merge of both."""
    origin = Repository(folder / "origin", monkeypatch)
    monkeypatch.chdir(origin.folder)
    Path("arm.urdf").write_text(ARMS)
    execute("init", "arm.urdf", "-q")
    execute("build", "-q")
    origin.commit()
    origin.git("branch", "topic")
    for branch, old, new in (("main", '"1"', '"2"'), ("topic", '"5"', '"6"')):
        origin.git("checkout", "-q", branch)
        edit("arm.urdf", f"mass value={old}", f"mass value={new}")
        execute("build", "-q")
        origin.commit()
    origin.git("checkout", "-q", "--detach", "main")
    origin.git("merge", "-q", "--no-ff", "-m", "Merge topic into main", "topic")
    origin.git("update-ref", "refs/pull/7/merge", "HEAD")
    return origin


def check_out(origin: Repository, monkeypatch: pytest.MonkeyPatch, depth: int = 0) -> None:
    """Check the merge out as actions/checkout does, with this `fetch-depth`, and change to that folder."""
    clone = Repository(origin.folder.parent / "checkout", monkeypatch)
    merge = "+refs/pull/7/merge:refs/remotes/pull/7/merge"
    wanted = [f"--depth={depth}", merge] if depth else ["+refs/heads/*:refs/remotes/origin/*", merge]
    clone.git("fetch", "-q", origin.folder.as_uri(), *wanted)
    clone.git("checkout", "-q", "--force", "refs/remotes/pull/7/merge")
    monkeypatch.chdir(clone.folder)


@pytest.mark.slow
@posix
@NEEDS_GIT
@pytest.mark.parametrize(("against", "depth"), [("HEAD^1", 2), ("origin/main", 0)])
def test_of_a_merge_commit_the_action_reports_what_the_pull_request_changes(
    pull_request: Repository, monkeypatch: pytest.MonkeyPatch, against: str, depth: int
) -> None:
    check_out(pull_request, monkeypatch, depth)
    _, outputs = report(AGAINST=against)
    text = Path(outputs["comment"]).read_text(encoding="utf-8")
    assert f"1 parameter change since {against}" in text
    assert "5 → 6 kg" in text


@posix
@NEEDS_GIT
def test_the_action_passes_a_merge_commit(pull_request: Repository, monkeypatch: pytest.MonkeyPatch) -> None:
    check_out(pull_request, monkeypatch)
    code, outputs = report()
    assert code == Exit.IN_STEP
    assert json.loads(Path(outputs["sarif"]).read_text())["runs"][0]["results"] == []


@pytest.mark.slow
@posix
@NEEDS_GIT
def test_the_action_compares_with_a_revision_and_no_file_of_the_checkout(arm: Repository) -> None:
    arm.git("update-ref", "refs/remotes/origin/main", "HEAD~1")
    Path("origin").mkdir()
    for name in ("main", "main^0", "gone"):
        shutil.copy("arm.urdf", f"origin/{name}")
    _, outputs = report(AGAINST="origin/main")
    assert "1 → 2 kg" in Path(outputs["comment"]).read_text(encoding="utf-8")
    code, outputs = report(AGAINST="origin/gone")
    assert code == Exit.ERROR
    assert "is neither a file nor a revision" in Path(outputs["comment"]).read_text(encoding="utf-8")


# Installing


BACKEND = """\
import zipfile
def build_wheel(folder, config_settings=None, metadata_directory=None):
    name, info = "urdfsync-1-py3-none-any.whl", "urdfsync-1.dist-info"
    with zipfile.ZipFile(f"{folder}/{name}", "w") as wheel:
        metadata = "Metadata-Version: 2.1\\nName: urdfsync\\nVersion: 1\\nProvides-Extra: xacro\\n"
        wheel.writestr(f"{info}/METADATA", metadata)
        wheel.writestr(f"{info}/WHEEL", "Wheel-Version: 1.0\\nRoot-Is-Purelib: true\\nTag: py3-none-any\\n")
        wheel.writestr(f"{info}/entry_points.txt", "[console_scripts]\\nurdfsync = none:none\\n")
        wheel.writestr(f"{info}/RECORD", "")
    return name
"""
"""Build a package that pip installs without an index."""


def install(action: Path, place: Path, **variables: str) -> Path:
    """Run the installing step of the action, with a folder of the runner; return the program that the step names."""
    variables |= {"RUNNER_TEMP": str(place), "RUNNER_OS": "Linux", "GITHUB_ACTION_PATH": str(action)}
    variables |= {"GITHUB_ENV": str(place / "environment"), "EXTRAS": ""}
    path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
    assert run(INSTALL["run"], PATH=path, **variables) == 0
    name, program = (place / "environment").read_text().strip().split("=")
    assert name == "URDFSYNC"
    return Path(program)


@posix
@NEEDS_GIT
@pytest.mark.slow
def test_the_action_runs_nothing_of_the_checkout(arm: Repository, tmp_path_factory: pytest.TempPathFactory) -> None:
    """Variables have no effect, either; the step also installs xacro, in an environment of its own."""
    outside, action, runner = map(tmp_path_factory.mktemp, ("outside", "action", "runner"))
    (action / "backend.py").write_text(BACKEND)
    (action / "pyproject.toml").write_text(
        '[build-system]\nrequires = []\nbuild-backend = "backend"\nbackend-path = ["."]\n'
    )
    hostile.attack("modules", arm.folder, outside)
    for name in ("python", "git", "cat", "urdfsync"):
        Path(name).write_text(f"#!/bin/sh\ntouch {outside}/{name}\n")
        Path(name).chmod(0o755)
    for name in ("pip.conf", "pip.ini", "setup.cfg"):
        Path(name).write_text(f"[global]\ntarget = {outside}/{name}\n[install]\nprefix = {outside}/{name}\n")
    variables = {"PYTHONPATH": str(arm.folder), "PYTHONHOME": str(arm.folder)}
    assert "$GITHUB_ACTION_PATH[xacro$" in INSTALL["run"]
    assert install(action, runner, PIP_NO_INDEX="1", **variables) == runner / "urdfsync/bin/urdfsync"
    assert (runner / "urdfsync/bin/urdfsync").exists()
    assert report(AGAINST="HEAD~1", **variables)[0] == Exit.OUT_OF_STEP
    assert [path.name for path in outside.iterdir()] == []
