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
    return yaml.load(text, yaml.BaseLoader)  # which takes `on` for a word


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
    """A repository with a built arm, of which the last commit changes a mass in the source alone."""
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
    """Run the action's step that reports; its exit code and its outputs."""
    place = Path("runner")
    place.mkdir(exist_ok=True)
    files = {"GITHUB_STEP_SUMMARY": str(place / "summary"), "GITHUB_OUTPUT": str(place / "output")}
    given = dict.fromkeys(REPORT["env"], "") | inputs
    code = run(REPORT["run"], URDFSYNC=URDFSYNC, RUNNER_TEMP=str(place), **files, **given)
    return code, dict(line.split("=", 1) for line in Path(files["GITHUB_OUTPUT"]).read_text().splitlines())


@posix
@NEEDS_GIT
def test_the_action_reports_what_changed_and_that_the_package_is_out_of_step(arm: Repository) -> None:
    code, outputs = report(AGAINST="HEAD~1")
    assert code == Exit.OUT_OF_STEP
    summary = Path("runner/summary").read_text(encoding="utf-8")
    assert summary == Path(outputs["comment"]).read_text(encoding="utf-8")
    assert summary.startswith("<h3>⚠️ arm: 1 file to write")
    assert "since HEAD~1" in summary
    log = json.loads(Path(outputs["sarif"]).read_text())
    validate(log, "sarif")
    assert "out-of-step" in {result["ruleId"] for result in log["runs"][0]["results"]}


@posix
@NEEDS_GIT
def test_the_action_passes_if_all_is_in_step_though_the_sources_differ(arm: Repository, execute: Execute) -> None:
    execute("build", "-q")
    assert report(AGAINST="HEAD~1", ROBOTS="arm arm", CONFIG="urdfsync.toml")[0] == Exit.IN_STEP


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
    for name, script in (("pip", "exit 0"), ("curl", 'printf "%s\\n" "$@" > posted'), ("urdfsync", f'{URDFSYNC} "$@"')):
        (tools / name).write_text(f"#!/bin/sh\n{script}\n")
        (tools / name).chmod(0o755)
    variables = {"CI_API_V4_URL": "https://host/api", "CI_PROJECT_ID": "7", "CI_MERGE_REQUEST_IID": "3"}
    variables |= {"URDFSYNC_TOKEN": "secret", "URDFSYNC_ADDRESS": "x", "CI_MERGE_REQUEST_DIFF_BASE_SHA": "HEAD~1"}
    script = "\n".join(PIPELINE["models"]["script"])
    assert run(script, PATH=f"{tools.resolve()}:{os.environ['PATH']}", **variables) == Exit.OUT_OF_STEP
    assert "https://host/api/projects/7/merge_requests/3/notes" in Path("posted").read_text().splitlines()
    comment = Path("comment.md").read_text(encoding="utf-8")
    assert comment.index("since HEAD") < comment.index("⚠️ arm")


@posix
@pytest.mark.slow
def test_the_action_installs_urdfsync_apart_from_the_jobs_python(folder: Path) -> None:
    variables = {"RUNNER_TEMP": str(folder), "RUNNER_OS": "Linux", "GITHUB_ACTION_PATH": str(REPOSITORY)}
    path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
    assert run(INSTALL["run"], PATH=path, GITHUB_ENV="environment", EXTRAS="xacro", **variables) == 0
    name, program = Path("environment").read_text().strip().split("=")
    assert name == "URDFSYNC"
    subprocess.run([program, "--version"], check=True, capture_output=True)
    assert Path(program).with_name("xacro").exists()
