"""OpenModelica: models are compiled and balanced with it, not simulated. Untried with a real `omc`.

Written from the documentation of its scripting functions and of its client library, OMPython.
"""

from __future__ import annotations

import os
import re
import shutil
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import msgspec

from urdfsync.check.compilers.compiler import (
    CompileJob,
    CompileResult,
    CompileTask,
    Complaint,
    SimulationResult,
    one_line,
)
from urdfsync.extras import install_command

TITLE = "OpenModelica"
MODULES: tuple[str, ...] = ("OMPython",)
INSTALL = f"install OpenModelica and `{install_command('omc')}`, or check without `--tool omc`"
REPORT = "check without `--tool omc`, and report it to the authors of OpenModelica"
SIMULATES = False

Ask: TypeAlias = Callable[[str], str]
"""Sends an expression to `omc`, and returns its answer as it comes. Raises RefusedError."""

_STRING = re.compile(r'"((?:[^"\\]|\\.)*)"', re.DOTALL)
_ESCAPED = re.compile(r"\\(.)", re.DOTALL)
_ESCAPES = {"n": "\n", "t": "\t", "r": "\r"}
_COUNTS = re.compile(r"has (\d+) equation\(s\) and (\d+) variable\(s\)")
_FIRST = ("Complex", "ModelicaServices", "Modelica")  # what other libraries rest on

_MESSAGE = re.compile(
    r"^(?:\[(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+)-\d+:\d+:\w+\] )?(?P<level>Error|Warning|Notification): ",
    re.MULTILINE,
)


class RefusedError(Exception):
    """`omc` or its client library gives no answer, but says why."""


def missing_program() -> str:
    """See `Compiler`."""
    is_there = shutil.which("omc") or os.environ.get("OPENMODELICAHOME")
    return "" if is_there else "`omc` is not on the PATH"


def environment(cache: str, folder: str) -> dict[str, str]:  # noqa: ARG001 - see `Compiler`
    """See `Compiler`: the temporary folder is for its log, its port and what it may write."""
    return dict.fromkeys(("TMPDIR", "TEMP", "TMP"), folder)


def complaints(problem: str) -> list[Complaint]:
    """See `Compiler`. Each message goes on to the beginning of the next one; only errors count."""
    found = list(_MESSAGE.finditer(problem))
    ends = [*(one.start() for one in found[1:]), len(problem)]
    errors = []
    for one, end in zip(found, ends, strict=bool(found)):
        if one["level"] == "Error":
            words, line, column = one_line(problem[one.end() : end]), int(one["line"] or 0), int(one["column"] or 0)
            errors.append(Complaint(words, file=one["file"] or "", line=line, column=column))
    words = one_line(problem)
    return errors or ([Complaint(words)] if words else [])


def work(job: CompileJob) -> Iterator[CompileResult]:
    """Do all tasks in one session, in order. Raises ImportError without OMPython, or if `omc` does not start."""
    try:
        ask = _session()
    except (RefusedError, OSError) as error:
        raise ImportError(str(error)) from error
    yield from results(ask, job)


def results(ask: Ask, job: CompileJob) -> Iterator[CompileResult]:
    """Load the libraries, and do the tasks one by one; what can't be loaded is the problem of each of them."""
    try:
        ask("cd(getTempDirectoryPath())")
        answers = (load_problem(ask(load_expression(file))) for file in package_files(job.roots))
        problem = next(filter(None, answers), "")
    except RefusedError as refused:
        problem = str(refused)
    for task in job.tasks:
        started = time.monotonic()
        result = CompileResult(problem) if problem else _check(ask, task)
        yield msgspec.structs.replace(result, seconds=time.monotonic() - started)


def package_files(roots: Sequence[str]) -> list[Path]:
    """The files to load so that everything in `roots` is there: packages, or folders of packages; libraries first."""
    found: list[Path] = []
    for root in map(Path, roots):
        if root.is_file() or (root / "package.mo").is_file():
            found.append(root if root.is_file() else root / "package.mo")
        else:
            found += sorted([*root.glob("*/package.mo"), *root.glob("*.mo")])

    def rank(file: Path) -> int:
        name = (file.parent if file.name == "package.mo" else file).stem.split(" ")[0]
        return _FIRST.index(name) if name in _FIRST else len(_FIRST)

    return sorted(found, key=rank)


def load_expression(file: Path) -> str:
    """The expression that loads a package, and nothing besides that it names as used."""
    return _with_messages(f"loadFile({quoted(file.as_posix())}, uses=false)")


def check_expressions(task: CompileTask) -> tuple[str, str]:
    """The expressions that make a task's text known and check its model."""
    load = f"loadString({quoted(task.source)}, uses=false)"
    return _with_messages(load), _with_messages(f"checkModel({task.model})")


def _with_messages(call: str) -> str:
    """A call and, in the same breath, what there is to say of it: else the client library takes that for itself."""
    return f"{call}; getErrorString()"


def quoted(text: str) -> str:
    """A text as a literal of Modelica."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def strings(answer: str) -> list[str]:
    """The texts in an answer, without their quotes."""
    return [_ESCAPED.sub(lambda match: _ESCAPES.get(match[1], match[1]), text) for text in _STRING.findall(answer)]


def load_problem(answer: str) -> str:
    """What is wrong according to the answer to a call that loads something; empty if it is there."""
    if answer.lstrip().startswith("true"):
        return ""
    return "\n".join(filter(None, map(str.strip, strings(answer)))) or "it can't be loaded, and does not say why"


def check_result(answer: str, task: CompileTask) -> CompileResult:
    """What became of a task, from the answer to `checkModel`."""
    said, *messages = strings(answer) or [answer]
    counts = _COUNTS.search(said)
    if "completed successfully" not in said or counts is None:
        return CompileResult("\n".join(filter(None, map(str.strip, (*messages, said)))) or "the model does not compile")
    equations, unknowns = map(int, counts.groups())
    if equations != unknowns:
        return CompileResult(f"unbalanced model: {equations} equations, {unknowns} unknowns")
    runs = tuple(SimulationResult(problem="OpenModelica only compiles here") for _ in task.runs)
    return CompileResult(unknowns=unknowns, runs=runs)


def _check(ask: Ask, task: CompileTask) -> CompileResult:
    load, check = check_expressions(task)
    try:
        problem = load_problem(ask(load))
        return CompileResult(problem) if problem else check_result(ask(check), task)
    except RefusedError as refused:
        return CompileResult(str(refused))


def _session() -> Ask:
    """Start `omc`. Raises ImportError without its client library, RefusedError or OSError if it does not start."""
    import OMPython  # an optional extra

    begin: Any = getattr(OMPython, "OMCSessionLocal", None) or OMPython.OMCSessionZMQ  # the name until 4.0
    names = ("OMSessionException", "OMCSessionException")
    errors = tuple(getattr(OMPython, name) for name in names if hasattr(OMPython, name))

    def ask(expression: str) -> str:
        try:
            return str(session.sendExpression(expression, parsed=False))
        except errors as error:
            raise RefusedError(str(error)) from error

    try:
        session = begin()
    except errors as error:
        raise RefusedError(str(error)) from error
    return ask
