"""Writes findings as SARIF 2.1.0, which code hosts and editors show at their lines.

Source: OASIS, Static Analysis Results Interchange Format 2.1.0 with errata 01; GitHub shows no result without a rule's
texts, a file and a line.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import quote

from urdfsync.common.diagnostics import Diagnostic
from urdfsync.common.version import __version__
from urdfsync.engine.result import Exit
from urdfsync.output.sections import Section
from urdfsync.project import config, git

_SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"

_ESCAPES = str.maketrans({**{char: f"\\{char}" for char in "[]\\"}, "{": "{{", "}": "}}"})
"""Signs of embedded links, and of placeholders (3.11.5, 3.11.6): names in a message may be a stranger's."""


def document(sections: Iterable[Section], findings: Sequence[Diagnostic], code: int) -> str:
    """Return a log of one run with all findings; `code` is the exit code.

    A finding without a file is a notification about the run. Looks for `.git`, and reads the page of all findings.
    """
    of_robots = ((*section.findings, *filter(None, [section.verdict])) for section in sections)
    told = dict.fromkeys([*findings, *(finding for group in of_robots for finding in group)])
    folder, meanings = config.working_folder(), read_meanings()
    top = Path(git.find_top(folder) or folder)
    results, notifications = [], []
    for finding in told:
        values = {"level": str(finding.severity), "message": {"text": finding.sentence.translate(_ESCAPES)}}
        if finding.file:
            location = {"physicalLocation": _location(finding, top)}
            results.append({"ruleId": finding.code, **values, "locations": [location]})
        else:
            notifications.append({"descriptor": {"id": finding.code}, **values})
    rules = []
    for rule in sorted({finding.code for finding in told}):
        text = {"text": meanings.get(rule, "the message says what to do").translate(_ESCAPES)}
        rules.append({"id": rule, "shortDescription": text, "fullDescription": text, "help": text})
    invocation = {
        "executionSuccessful": code not in (Exit.ERROR, Exit.LOCKED, Exit.INTERRUPTED),
        "exitCode": int(code),
        "toolExecutionNotifications": notifications,
    }
    run = {
        "tool": {"driver": {"name": "urdfsync", "semanticVersion": __version__, "rules": rules}},
        "columnKind": "unicodeCodePoints",
        "invocations": [invocation],
        "results": results,
    }
    return json.dumps({"$schema": _SCHEMA, "version": "2.1.0", "runs": [run]}, indent=2) + "\n"


def read_meanings() -> dict[str, str]:
    """Return the meaning of each code from docs/findings.md."""
    return {code: meaning for code, (meaning,) in config.explained("findings.md")}


def _location(finding: Diagnostic, top: Path) -> dict[str, Any]:
    """Return the place of a finding; line 1 for a whole file."""
    region = {"startLine": finding.line or 1} | ({"startColumn": finding.column} if finding.column else {})
    file = Path(os.path.normpath(config.working_folder() / finding.file))
    if not file.is_relative_to(top):
        return {"artifactLocation": {"uri": file.as_uri()}, "region": region}
    uri = quote(os.fsencode(file.relative_to(top).as_posix()))
    return {"artifactLocation": {"uri": uri, "uriBaseId": "%SRCROOT%"}, "region": region}
