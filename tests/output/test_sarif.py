"""Findings as SARIF: valid, at their lines, with the meaning of each code."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema_rs
import pytest
from support.schemas import validate

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.output.sarif import document, read_meanings
from urdfsync.output.sections import Mark, Section

CYCLE = Diagnostic(Severity.ERROR, "cycle", "link a|b is below itself", "cad/my arm.urdf", 7, 3, hint="correct it")
STRAY = Diagnostic(Severity.WARNING, "stray-template", "no template", "arm.mo")
LOCKED = Diagnostic(Severity.ERROR, "locked", "another build is running")


def run_of(*findings: Diagnostic, code: int = 0, verdict: Diagnostic | None = None) -> Any:
    """The run in a valid log of one robot's findings."""
    section = Section("arm", "1 error", Mark.WRONG, findings=findings, verdict=verdict)
    log = json.loads(document([section], [], code))
    validate(log, "sarif")
    (run,) = log["runs"]
    return run


def places(run: Any) -> Iterator[Any]:
    return (result["locations"][0]["physicalLocation"] for result in run["results"])


def test_the_schema_refuses_a_log_without_a_message() -> None:
    log = json.loads(document([Section("arm", "", Mark.WRONG, findings=[CYCLE])], [], 2))
    del log["runs"][0]["results"][0]["message"]
    with pytest.raises(jsonschema_rs.ValidationError):
        validate(log, "sarif")


def test_a_finding_stands_at_its_line_below_the_top_of_the_repository(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / ".git").mkdir()
    (folder / "robots").mkdir()
    monkeypatch.chdir("robots")
    run = run_of(CYCLE, STRAY)
    uri = {"uri": "robots/cad/my%20arm.urdf", "uriBaseId": "%SRCROOT%"}
    place, whole_file = places(run)
    assert place == {"artifactLocation": uri, "region": {"startLine": 7, "startColumn": 3}}
    assert whole_file["region"] == {"startLine": 1}
    assert [result["level"] for result in run["results"]] == ["error", "warning"]
    assert run["results"][0]["message"]["text"] == "link a|b is below itself; correct it"


@pytest.mark.parametrize(
    ("message", "text"),
    [
        ("see [here](https://evil) [1](0)", r"see \[here\](https://evil) \[1\](0)"),
        (r"see \[here](0)", r"see \\\[here\](0)"),
        ("{0} of {{1}}", "{{0}} of {{{{1}}}}"),
    ],
)
def test_a_message_has_neither_links_nor_placeholders(folder: Path, message: str, text: str) -> None:
    run = run_of(Diagnostic(Severity.ERROR, "cycle", message, "a"), Diagnostic(Severity.ERROR, "locked", message))
    (notification,) = run["invocations"][0]["toolExecutionNotifications"]
    assert run["results"][0]["message"]["text"] == notification["message"]["text"] == text
    restored = re.sub(r"\\([\[\]\\])", r"\1", text).replace("{{", "{").replace("}}", "}")
    assert restored == message


def test_a_file_outside_of_the_repository_has_a_whole_address(folder: Path) -> None:
    (place,) = places(run_of(Diagnostic(Severity.NOTE, "texture", "grey", "/opt/robots/arm.dae")))
    assert place["artifactLocation"] == {"uri": "file:///opt/robots/arm.dae"}


def test_rules_explain_the_codes_as_the_page_does(folder: Path) -> None:
    kept = Diagnostic(Severity.WARNING, "kept-save", "x", "y")
    run = run_of(CYCLE, kept, Diagnostic(Severity.ERROR, "new-code", "x", "y"))
    rules = run["tool"]["driver"]["rules"]
    assert [rule["id"] for rule in rules] == ["cycle", "kept-save", "new-code"]
    assert [result["ruleId"] for result in run["results"]] == ["cycle", "kept-save", "new-code"]
    assert [rule["help"]["text"] for rule in rules[1:]] == [
        "you saved a file during a build; the other text is beside it",
        "the message says what to do",
    ]


def test_every_code_of_the_page_has_a_meaning_without_markup() -> None:
    meanings = read_meanings()
    assert len(meanings) > 50
    assert all(meaning and "](" not in meaning for meaning in meanings.values())
    assert meanings["mesh-guessed"].endswith("the build uses a file in a folder around the source")


def test_what_names_no_file_is_a_notification_of_the_run(folder: Path) -> None:
    run = run_of(LOCKED, code=4)
    (invocation,) = run["invocations"]
    assert (invocation["executionSuccessful"], invocation["exitCode"], run["results"]) == (False, 4, [])
    assert [told["message"]["text"] for told in invocation["toolExecutionNotifications"]] == [LOCKED.message]


def test_the_verdict_on_a_package_is_a_result(folder: Path) -> None:
    verdict = Diagnostic(Severity.WARNING, "out-of-step", "the package Arm is out of step", "Arm/package.mo")
    run = run_of(verdict=verdict, code=1)
    assert [result["ruleId"] for result in run["results"]] == ["out-of-step"]
    assert run["invocations"][0]["executionSuccessful"]
