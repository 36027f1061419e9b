"""Findings as SARIF 2.1.0, which code hosts and editors show at their lines.

Source: OASIS, Static Analysis Results Interchange Format 2.1.0 with errata 01; GitHub shows no result without a rule's
texts, a file and a line.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import quote

from urdfsync import __version__, config
from urdfsync.diagnostics import Diagnostic
from urdfsync.engine.result import Exit
from urdfsync.output.markdown import Section

_SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
_ROW = re.compile(r"^\| (`[^|]*`) \| ([^|]*) \|(?: ([^|]*) \|)?$", re.MULTILINE)
_LINK = re.compile(r"\[([^\]]*)\]\([^)]*\)")


class Meaning(NamedTuple):
    """A code as docs/findings.md explains it."""

    text: str
    consequence: str


def log(sections: Iterable[Section], findings: Sequence[Diagnostic], code: int) -> str:
    """Return a log of one run with the findings of robots and those of none; `code` is the exit code.

    What names no file is a notification about the run.
    """
    per_robot = ((*section.findings, *filter(None, [section.verdict])) for section in sections)
    told = list(dict.fromkeys([*findings, *(finding for group in per_robot for finding in group)]))
    rules = {rule: number for number, rule in enumerate(sorted({finding.code for finding in told}))}
    meanings, top = read_meanings(), _top()
    run = {
        "tool": {
            "driver": {
                "name": "urdfsync",
                "semanticVersion": __version__,
                "rules": [_rule(rule, meanings) for rule in rules],
            }
        },
        "columnKind": "unicodeCodePoints",
        "invocations": [
            {
                "executionSuccessful": code not in (Exit.ERROR, Exit.LOCKED, Exit.INTERRUPTED),
                "exitCode": int(code),
                "toolExecutionNotifications": [
                    {
                        "descriptor": {"id": finding.code, "index": rules[finding.code]},
                        "level": str(finding.severity),
                        "message": {"text": _message(finding)},
                    }
                    for finding in told
                    if not finding.file
                ],
            }
        ],
        "results": [
            {
                "ruleId": finding.code,
                "ruleIndex": rules[finding.code],
                "level": str(finding.severity),
                "message": {"text": _message(finding)},
                "locations": [{"physicalLocation": _location(finding, top)}],
            }
            for finding in told
            if finding.file
        ],
    }
    return json.dumps({"$schema": _SCHEMA, "version": "2.1.0", "runs": [run]}, indent=2) + "\n"


def read_meanings() -> dict[str, Meaning]:
    """Return the codes that docs/findings.md explains."""
    page = config.docs_page("findings.md").read_text(encoding="utf-8")
    return {
        code: Meaning(*(_LINK.sub(r"\1", cell).strip() for cell in (meaning, consequence)))
        for codes, meaning, consequence in _ROW.findall(page)
        for code in re.findall("`([^`]+)`", codes)
    }


def _rule(code: str, meanings: Mapping[str, Meaning]) -> dict[str, Any]:
    meaning = meanings.get(code, Meaning(code.replace("-", " "), "its message says what to do"))
    help_text = meaning.text + (f" ({meaning.consequence})" if meaning.consequence else "")
    texts = {"shortDescription": meaning.text, "fullDescription": help_text, "help": help_text}
    return {"id": code, **{key: {"text": text} for key, text in texts.items()}}


def _message(finding: Diagnostic) -> str:
    return "; ".join(filter(None, (finding.message, finding.hint)))


def _location(finding: Diagnostic, top: Path) -> dict[str, Any]:
    """Return a place; a finding about a whole file stands at its first line."""
    region = {"startLine": finding.line or 1} | ({"startColumn": finding.column} if finding.column else {})
    file = Path(os.path.normpath(config.working_folder() / finding.file))
    if not file.is_relative_to(top):
        return {"artifactLocation": {"uri": file.as_uri()}, "region": region}
    uri = quote(file.relative_to(top).as_posix())
    return {"artifactLocation": {"uri": uri, "uriBaseId": "%SRCROOT%"}, "region": region}


def _top() -> Path:
    """Return the top of the repository around the working folder, else that folder."""
    folder = config.working_folder()
    return next((place for place in (folder, *folder.parents) if (place / ".git").exists()), folder)
