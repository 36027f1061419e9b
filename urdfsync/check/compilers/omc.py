"""OpenModelica: models are compiled and balanced with it, not simulated. Untried with a real `omc`.

Written from the documentation of its scripting functions and of its client library, OMPython.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

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
METHODS: tuple[str, ...] = ()

_FIRST = ("Complex", "ModelicaServices", "Modelica")  # what other libraries rest on
_STRING = re.compile(r'"((?:[^"\\]|\\.)*)"', re.DOTALL)
_ESCAPED = re.compile(r"\\(.)", re.DOTALL)
_ESCAPES = {"n": "\n", "t": "\t", "r": "\r"}
_COUNTS = re.compile(r"has (\d+) equation\(s\) and (\d+) variable\(s\)")
_MESSAGE = re.compile(
    r"^(?:\[(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+)-\d+:\d+:\w+\] )?(?P<level>Error|Warning|Notification): ",
    re.MULTILINE,
)


def program() -> str | None:
    """See `Compiler`. The client library prefers the variable to the PATH."""
    home = os.environ.get("OPENMODELICAHOME")
    return str(Path(home, "bin", "omc")) if home else shutil.which("omc")


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
    """See `Compiler`: one session; what can't be loaded is the problem of each task."""
    import OMPython  # an optional extra

    try:
        session = OMPython.OMCSessionLocal()
    except (OMPython.OMSessionException, OSError) as error:
        raise ImportError(str(error)) from error

    def ask(call: str) -> str:
        return str(session.sendExpression(call, parsed=False))

    problem = ""
    try:
        ask("cd(getTempDirectoryPath())")
        calls = (f"loadFile({quoted(file.as_posix())}, uses=false)" for file in _package_files(job))
        problem = next(filter(None, (_load(ask, call) for call in calls)), "")
    except OMPython.OMSessionException as error:
        problem = str(error)
    for task in job.tasks:
        try:
            result = CompileResult(problem) if problem else _compile(ask, task)
        except OMPython.OMSessionException as error:
            result = CompileResult(str(error))
        yield result


def _load(ask: Callable[[str], str], call: str) -> str:
    """Load something; returns what is wrong, empty if it is there."""
    answer = ask(f"{call}; getErrorString()")
    if answer.lstrip().startswith("true"):
        return ""
    return "\n".join(filter(None, map(str.strip, strings(answer)))) or "OpenModelica can't load it and gives no reason"


def _compile(ask: Callable[[str], str], task: CompileTask) -> CompileResult:
    if problem := _load(ask, f"loadString({quoted(task.source)}, uses=false)"):
        return CompileResult(problem)
    # the messages in the same breath, or the client library takes them for itself
    answer = ask(f"checkModel({task.model}); getErrorString()")
    said, *messages = strings(answer) or [answer]
    counts = _COUNTS.search(said)
    if "completed successfully" not in said or counts is None:
        words = "\n".join(filter(None, map(str.strip, (*messages, said))))
        return CompileResult(words or "the model does not compile")
    if counts[1] != counts[2]:
        return CompileResult(f"unbalanced model: {counts[1]} equations, {counts[2]} unknowns")
    runs = tuple(SimulationResult(problem="OpenModelica only compiles here") for _ in task.runs)
    return CompileResult(unknowns=int(counts[2]), runs=runs)


def _package_files(job: CompileJob) -> list[Path]:
    """The files to load so that all roots are there, which are packages or folders of packages; libraries first."""
    found: list[Path] = []
    for root in map(Path, job.roots):
        whole = root if root.is_file() else root / "package.mo"
        found += [whole] if whole.is_file() else sorted([*root.glob("*/package.mo"), *root.glob("*.mo")])

    def rank(file: Path) -> int:
        name = (file.parent if file.name == "package.mo" else file).stem.split(" ")[0]
        return _FIRST.index(name) if name in _FIRST else len(_FIRST)

    return sorted(found, key=rank)


def quoted(text: str) -> str:
    """A text as a literal of Modelica."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def strings(answer: str) -> list[str]:
    """The texts in an answer, without their quotes."""
    return [_ESCAPED.sub(lambda match: _ESCAPES.get(match[1], match[1]), text) for text in _STRING.findall(answer)]
