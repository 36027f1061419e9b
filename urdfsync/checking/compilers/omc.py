"""OpenModelica as the compiler of a check: compile and balance, no simulation. Untried with a real `omc`.

Written from the documentation of its scripting functions and of its client library, OMPython. `omc` runs below a
process of ours (`omc_worker`), so that it is under the same limits as the embedded compiler. What it says, and what
it is told, is put together and taken apart here.
"""

from __future__ import annotations

import importlib.util
import os
import re
import shutil
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from urdfsync.checking.compilers.compiler import Tool, ask, ignore, missing
from urdfsync.checking.compilers.tasks import Job, Outcome, Series, Task
from urdfsync.checking.process import Limits
from urdfsync.extras import install_command

OMC = Tool(
    "OpenModelica",
    "urdfsync.checking.compilers.omc_worker",
    f"install OpenModelica and `{install_command('check', 'omc')}`, or check without `--tool omc`",
    "check without `--tool omc`, and report it to the authors of OpenModelica",
)
NOT_SIMULATED = "OpenModelica only compiles here"

_STRING = re.compile(r'"((?:[^"\\]|\\.)*)"', re.DOTALL)
_ESCAPED = re.compile(r"\\(.)", re.DOTALL)
_ESCAPES = {"n": "\n", "t": "\t", "r": "\r"}
_COMPLETED = "completed successfully"
_COUNTS = re.compile(r"has (\d+) equation\(s\) and (\d+) variable\(s\)")
_FIRST = ("Complex", "ModelicaServices", "Modelica")
"""What other libraries rest on."""


class OpenModelica:
    """Asks `omc` whether models compile, and are balanced. It does not say how many states there are."""

    def compile(self, job: Job, limits: Limits, tell: Callable[[int, Outcome], None] = ignore) -> list[Outcome]:
        """See `Compiler.compile`; runs that a task asks for fail."""
        require()
        with tempfile.TemporaryDirectory(prefix="urdfsync-omc-", ignore_cleanup_errors=True) as folder:
            place = dict.fromkeys(("TMPDIR", "TEMP", "TMP"), folder)  # for its log, its port and what it may write
            return ask(OMC, job, limits, place, tell)


def require() -> None:
    """Raise CompilerError, with what to install, if `omc` or its client library is missing."""
    for name in ("psutil", "platformdirs", "OMPython"):
        if importlib.util.find_spec(name) is None:
            raise missing(OMC, f"{name} is not installed")
    if shutil.which("omc") is None and not os.environ.get("OPENMODELICAHOME"):
        raise missing(OMC, "`omc` is not on the PATH")


# --- what omc is told -------------------------------------------------------------------------------------------------


def packages(roots: Sequence[str]) -> list[Path]:
    """The files to load so that everything in `roots` is there: packages, or folders of packages; libraries first."""
    found = [file for root in roots for file in _packages(Path(root))]

    def rank(file: Path) -> int:
        name = (file.parent if file.name == "package.mo" else file).stem.split(" ")[0]
        return _FIRST.index(name) if name in _FIRST else len(_FIRST)

    return sorted(found, key=rank)


def _packages(root: Path) -> Iterator[Path]:
    if root.is_file():
        yield root
    elif (root / "package.mo").is_file():
        yield root / "package.mo"
    else:
        yield from sorted([*root.glob("*/package.mo"), *root.glob("*.mo")])


def loading(file: Path) -> str:
    """The expression that loads a package, and nothing besides that it names as used."""
    return with_messages(f"loadFile({quoted(file.as_posix())}, uses=false)")


def checking(task: Task) -> Sequence[str]:
    """The expressions that make a task's text known and check its model."""
    return (
        with_messages(f"loadString({quoted(task.source)}, uses=false)"),
        with_messages(f"checkModel({task.model})"),
    )


def with_messages(call: str) -> str:
    """A call and, in the same breath, what there is to say of it: else the client library takes that for itself."""
    return f"{call}; getErrorString()"


def quoted(text: str) -> str:
    """A text as a literal of Modelica."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


# --- what omc says ----------------------------------------------------------------------------------------------------


def strings(answer: str) -> list[str]:
    """The texts in an answer, without their quotes."""
    return [_ESCAPED.sub(lambda match: _ESCAPES.get(match[1], match[1]), text) for text in _STRING.findall(answer)]


def loaded(answer: str) -> str:
    """What is wrong according to the answer to a call that loads something; empty if it is there."""
    if answer.lstrip().startswith("true"):
        return ""
    return "\n".join(filter(None, map(str.strip, strings(answer)))) or "it can't be loaded, and does not say why"


def outcome(answer: str, task: Task) -> Outcome:
    """What became of a task, from the answer to `checkModel`."""
    said, *messages = strings(answer) or [answer]
    counts = _COUNTS.search(said)
    if _COMPLETED not in said or counts is None:
        return Outcome("\n".join(filter(None, map(str.strip, (*messages, said)))) or "the model does not compile")
    equations, unknowns = map(int, counts.groups())
    if equations != unknowns:
        return Outcome(f"unbalanced model: {equations} equations, {unknowns} unknowns")
    return Outcome(unknowns=unknowns, runs=tuple(Series(problem=NOT_SIMULATED) for _ in task.runs))
