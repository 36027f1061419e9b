"""OpenModelica: `omc SCRIPT.mos` runs each job; the output of `omc` has the answers, files have the results.

Written for the answers that OpenModelica 1.27 gave, see docs/openmodelica.md.
"""

from __future__ import annotations

import math
import os
import re
import subprocess
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import msgspec

from urdfsync.analysis.checks.compilers.compiler import (
    CompileJob,
    CompilerError,
    CompileResult,
    CompileTask,
    Complaint,
    Simulation,
    SimulationResult,
    one_line,
)
from urdfsync.common import system
from urdfsync.common.processes import exit_cause
from urdfsync.modelica.names import STANDARD_LIBRARIES

TITLE = "OpenModelica"
MODULES: tuple[str, ...] = ("scipy",)
INSTALL = "install OpenModelica, or name its program with `omc` in the table `[check]`"
METHODS: tuple[str, ...] = ("dassl", "ida", "cvode", "rungekutta", "euler")
HAS_STANDARD_LIBRARY = True
REUSES_MODELS = False
STARTS_PROGRAMS = True

_TOLERANCE = 1e-8
_PATIENCE = 30.0
"""Seconds after which OpenModelica must have told its version."""
_MATCHING = "--matchingAlgorithm=PFPlus"
"""The default, PFPlusExt, takes five times as long for many joints in loops, and gives the same result."""
_NOBODY = "http://127.0.0.1:9"
_VALUE = re.compile(
    r"\s*(?:(?P<record>record (?P<name>\w+)\n.*?\nend (?P=name);)"
    r'|"(?P<text>(?:[^"\\]|\\.)*)"|(?P<word>true|false))(?=\n|\Z)',
    re.DOTALL,
)
_FIELD = re.compile(r'^ *(\w+) = "((?:[^"\\]|\\.)*)"', re.MULTILINE | re.DOTALL)
_ESCAPED = re.compile(r"\\(.)", re.DOTALL)
_ESCAPES = {"n": "\n", "t": "\t", "r": "\r"}
_COUNTS = re.compile(r"has (\d+) equation\(s\) and (\d+) variable\(s\)")
_MESSAGE = re.compile(
    r"^(?:\[(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+)-\d+:\d+:\w+\] )?(?P<level>Error|Warning|Notification): ",
    re.MULTILINE,
)
_UNITS, _UNITS_GO_ON = "INCONSISTENT due to specified unit information", "The units of following sub-expressions"
_MIXED = re.compile(r'\bsub-expression "(?:commands|positions)\[\d+\]" has unit')
"""OpenModelica 1.27 takes the first unit of an array for all its items, so it doubts Run's vector of inputs."""
_FOLLOWS = re.compile(
    r"Failed to load package |Class \S+ not found in scope <top>|Curl error|Failed to download"
    r"|Internal error Failed to move",
    re.IGNORECASE,
)
"""Messages that only follow from another one."""
_ASSERTION = re.compile(
    r"^\[(?P<file>.*?):(?P<line>\d+):\d+-\d+:\d+:\w+\]\n.*violated at time (?P<time>[-+.\deE]*\d)\n"
    r".* --> \"(?P<text>(?s:.*))",
    re.MULTILINE,
)
"""Matches up to the end of the log; a quotation mark at the end of a line ends the text."""
_TERMINATED = re.compile(r"^(?>.*?call terminate\(\) at time ).*+\n.*?Message : (.*)", re.MULTILINE)
_BUILDS = re.compile(r"Error building simulator|Failed to get version from cmake")
_LOG = re.compile(r"^(?:LOG_\w+)? *\| *(?P<level>\w+|\|) *\|? *\|? *")


class _Answer(NamedTuple):
    """The value that OpenModelica gives for a call, and its messages."""

    value: str
    messages: str


def program(named: str) -> str | None:
    """See `Compiler`: the named program, else `omc` below OPENMODELICAHOME, on the PATH, or where Windows has it."""
    if named:
        return system.find_program(named)
    home = os.environ.get("OPENMODELICAHOME")
    inside = system.find_program("omc", path=str(Path(home, "bin"))) if home else None
    usual = os.pathsep.join(system.program_files("OpenModelica*/bin"))
    return inside or system.find_program("omc") or system.find_program("omc", path=usual)


def state(named: str) -> tuple[str, list[Path]]:
    """See `Compiler`: the program, its shared libraries, and the Modelica Standard Library that comes with it.

    The program may be a script that starts another program, so urdfsync also asks for the version.
    """
    file = Path(program(named) or "").resolve()
    with tempfile.TemporaryDirectory(prefix="urdfsync-", ignore_cleanup_errors=True) as folder:
        try:
            ((version, _),) = _ask(CompileJob((), (), named), Path(folder), ["getVersion()"], _PATIENCE)
        except (ImportError, subprocess.TimeoutExpired) as error:
            raise OSError(str(error)) from error
    libraries = (f"lib/omlibrary/{name}*" for name in STANDARD_LIBRARIES)
    patterns = "lib/omc/*.so*", "lib/*/omc/*.so*", "bin/*.dll", *libraries
    return version, [file, *(path for pattern in patterns for path in sorted(file.parent.parent.glob(pattern)))]


def environment(cache: str, folder: str) -> dict[str, str]:  # noqa: ARG001 - see `Compiler`
    """See `Compiler`: the temporary folder is for scripts and all that OpenModelica writes."""
    # omc downloads an index of libraries if there is none on disk: an unreachable proxy prevents that.
    proxies = dict.fromkeys(("http_proxy", "https_proxy"), _NOBODY) | dict.fromkeys(("no_proxy", "NO_PROXY"), "")
    return dict.fromkeys(("TMPDIR", "TEMP", "TMP"), folder) | proxies


def complaints(problem: str) -> list[Complaint]:
    """See `Compiler`.

    A message ends where the next one begins; notifications are no complaints. If an error in a library has two places,
    the first place counts, which a notification names.
    """
    result, origin = list[Complaint](), Complaint("")
    messages = list(_MESSAGE.finditer(problem))
    ends = [*(message.start() for message in messages[1:]), len(problem)]
    for message, end in zip(messages, ends, strict=bool(messages)):
        words = one_line(problem[message.end() : end])
        if _BUILDS.search(words):
            words = f"{words}; OpenModelica needs a C compiler, make, and for FMUs cmake: install them"
        place = Complaint("", message["file"] or "", int(message["line"] or 0), int(message["column"] or 0))
        if message["level"] == "Notification":
            if words == "From here:":
                origin = place
            continue
        if result and not message["file"] and words.startswith(_UNITS_GO_ON):
            result[-1] = msgspec.structs.replace(result[-1], message=f"{result[-1].message}; {words}")
            continue
        code = "compiler-warning" if message["level"] == "Warning" else "does-not-compile"
        code = "units" if _UNITS in words else code
        result.append(msgspec.structs.replace(origin if origin.file else place, message=words, code=code))
        origin = Complaint("")
    result = [one for one in result if one.code != "units" or not _MIXED.search(one.message)]
    result = [complaint for complaint in result if not _FOLLOWS.match(complaint.message)] or result
    return result or ([Complaint(one_line(problem))] if problem.strip() and not messages else [])


def work(job: CompileJob) -> Iterator[CompileResult]:
    """See `Compiler`: one script does all tasks. If a file can't be loaded, each task has that problem."""
    folder = Path(tempfile.mkdtemp())
    version = _ask(job, folder, ["getVersion()"])[0].value
    is_webassembly = version.endswith("-rust")  # OpenModelica in Rust has only this target, without a C compiler
    flags = _MATCHING + " --simCodeTarget=wasm-jit" * is_webassembly
    if any(task.export for task in job.tasks):  # without a solver, co-simulation uses Euler's method
        flags += f" --fmiFlags=s:{'dassl' if is_webassembly else 'cvode'}"
    files = [f"loadFile({quoted(path.as_posix())})" for path in _package_files(job)]
    loads = [f"setCommandLineOptions({quoted(flags)})", "loadModel(Modelica)", *files]
    calls = [_calls(task, number, folder) for number, task in enumerate(job.tasks)]
    answers = iter(_ask(job, folder, [*loads, *(call for some in calls for call in some)]))
    problem = "\n".join(_problem(next(answers)) for _ in loads).strip()
    for task, some in zip(job.tasks, calls, strict=True):
        given = [next(answers) for _ in some]
        result = CompileResult(problem) if problem else _result(task, given, folder)
        # the task's own text is no file of the user's
        own = re.compile(rf"\[{re.escape((folder / 'task').as_posix())}\d+\.mo:[^][]*\] ")
        result = msgspec.structs.replace(result, problem=own.sub("", result.problem))
        yield msgspec.structs.replace(result, version=version.removeprefix("OpenModelica ").removeprefix("v"))


def _calls(task: CompileTask, number: int, folder: Path) -> list[str]:
    """Return the calls for a task: load the task's text, then check or simulate the model."""
    file = folder / f"task{number}.mo"
    file.write_text(task.source, encoding="utf-8")
    calls = [f"loadFile({quoted(file.as_posix())})"]
    if export := task.export:
        kind = f'version="{export.version}", fmuType="{export.kind}"'
        return [*calls, f"buildModelFMU({task.model}, {kind}, fileNamePrefix={quoted(task.model)})"]
    if task.parameters and not task.runs:  # only the result of a run names all parameters
        return [*calls, f'simulate({task.model}, stopTime=1e-6, outputFormat="mat", fileNamePrefix="names{number}")']
    if not task.runs:
        return [*calls, f"checkModel({task.model})"]
    for each, run in enumerate(task.runs):
        calls.append(f"simulate({task.model}, {_settings(run)}, fileNamePrefix={quoted(f'task{number}_{each}')})")
    return calls


def _settings(run: Simulation) -> str:
    changed = ",".join(f"{name}={value!r}" for name, value in run.parameters.items())
    override = f", simflags={quoted(f'-override={changed}')}" if changed else ""
    intervals, tolerance = max(1, round(run.stop / run.step)), run.tolerance or _TOLERANCE
    times = f"startTime=0, stopTime={run.stop!r}, numberOfIntervals={intervals}, tolerance={tolerance!r}"
    return f'{times}, method={quoted(run.method or METHODS[0])}, outputFormat="mat"{override}'


def _ask(job: CompileJob, folder: Path, calls: Sequence[str], seconds: float | None = None) -> list[_Answer]:
    """Return the answers to all calls. Raises ImportError or CompilerError if OpenModelica does not answer all calls.

    Raises TimeoutExpired after `seconds`; None sets no limit, since the process already has a limit.
    """
    script = folder / "script.mos"
    script.write_text("".join(f"{call}; getErrorString();\n" for call in calls), encoding="utf-8")
    try:
        done = subprocess.run(  # noqa: S603 - the user's own program
            system.command([program(job.program) or "omc", script.name]),
            cwd=folder,
            capture_output=True,
            stdin=subprocess.DEVNULL,
            check=False,
            timeout=seconds,
        )
    except OSError as error:
        raise ImportError(str(error)) from error
    answers, rest = read_answers(done.stdout.decode(errors="replace"))
    if len(answers) < len(calls):
        last_words = done.stderr.decode(errors="replace").strip().splitlines()[-1:] or rest.strip().splitlines()[:1]
        if len(calls) == 1:
            raise ImportError(": ".join(filter(None, (exit_cause(done.returncode), *last_words))))
        message = f"OpenModelica ended at `{calls[len(answers)]}` ({exit_cause(done.returncode)})"
        hint = f"{job.tasks[0].title}: report this to the authors of {TITLE}"
        raise CompilerError.of("compiler-crashed", ": ".join((message, *last_words)), hint=hint)
    return answers


def read_answers(printed: str) -> tuple[list[_Answer], str]:
    """Return the answers in OpenModelica's output, two values for each call, and the rest of the output."""
    values, end = list[str](), 0
    while match := _VALUE.match(printed, end):
        values.append(match["record"] or match["word"] or _text(match["text"]))
        end = match.end()
    return [_Answer(*pair) for pair in zip(values[::2], values[1::2], strict=False)], printed[end:]


def _problem(answer: _Answer) -> str:
    """Return why a file or library could not be loaded; empty if it was loaded."""
    if answer.value == "true":
        return ""
    return answer.messages.strip() or "OpenModelica can't load it and gives no reason"


def _result(task: CompileTask, answers: Sequence[_Answer], folder: Path) -> CompileResult:
    loaded, *rest = answers
    if problem := _problem(loaded):
        return CompileResult(problem)
    if task.runs:
        return _simulated(task, rest, folder)
    if task.export:
        return _exported(rest[0], folder)
    if task.parameters:
        return _without_parameters(task, rest, folder)
    ((answer, messages),) = rest
    counts = _COUNTS.search(answer)
    if "completed successfully" not in answer or counts is None:
        return CompileResult(
            "\n".join(filter(None, map(str.strip, (messages, answer)))) or "the model does not compile"
        )
    if counts[1] != counts[2]:
        return CompileResult(f"unbalanced model: {counts[1]} equations, {counts[2]} unknowns")
    return CompileResult(unknowns=int(counts[2]), warnings=messages.strip())


def _without_parameters(task: CompileTask, answers: Sequence[_Answer], folder: Path) -> CompileResult:
    """Return a result with all parameters of a model, if it lacks a parameter that the task sets."""
    everything = msgspec.structs.replace(task, runs=(Simulation(1.0, 1.0),), values=(), pattern=".*")
    result = _simulated(everything, answers, folder)
    names = tuple(result.runs[0].parameters) if result.runs and not result.runs[0].problem else None
    lacks_one = names is not None and not set(task.parameters).issubset(names)
    return CompileResult(result.problem, parameters=names if lacks_one else None)


def _exported(answer: _Answer, folder: Path) -> CompileResult:
    file = folder / answer.value
    if not answer.value or not file.is_file():
        return CompileResult(answer.messages.strip() or "OpenModelica makes no FMU and gives no reason")
    return CompileResult(fmu=file.read_bytes())


def _simulated(task: CompileTask, answers: Sequence[_Answer], folder: Path) -> CompileResult:
    runs = []
    for value, messages in answers:
        fields = {name: _text(text) for name, text in _FIELD.findall(value)}
        log = fields.get("messages", value)
        if fields.get("resultFile"):
            ended = _TERMINATED.search(log)
            run = _read_results(folder / fields["resultFile"], task)
            runs.append(msgspec.structs.replace(run, termination=ended[1].strip() if ended else ""))
        elif log.startswith("Failed to build model"):
            return CompileResult(messages.strip() or one_line(log))
        else:
            lines = [_LOG.sub("", line) for line in log.splitlines() if not line.startswith("LOG_SUCCESS")]
            text = "\n".join(filter(None, lines))
            if failed := _ASSERTION.search(text):
                words = failed["text"].partition('"\n')[0].removesuffix('"')
                text = f"assert failed at t={failed['time']}: {words} ({failed['file']}:{failed['line']})"
            runs.append(SimulationResult(problem=one_line(text.replace("\n", "; "))))
    return CompileResult(runs=tuple(runs))


def _read_results(file: Path, task: CompileTask) -> SimulationResult:
    """Read a trajectory in MATLAB's format 4. This format has parameters; CSV lacks parameters.

    Two tables have the numbers: `data_1` the constants at the beginning and at the end, `data_2` a column for each
    instant. `dataInfo` has the table and the row of each name, from 1 on; a negative row means negated numbers.
    """
    import numpy as np  # scipy depends on it
    from scipy.io import loadmat
    from scipy.io.matlab import MatReadError

    try:
        content: Any = loadmat(file, chars_as_strings=False)
        letters = np.ascontiguousarray(content["name"].T)
        places = zip(*content["dataInfo"][:2].astype(int).tolist(), strict=True)
        texts = letters.view(f"<U{letters.shape[1]}")[:, 0].tolist()
        rows = dict(zip(map(str.strip, texts), places, strict=True))
        tables = {1: content["data_1"], 2: content["data_2"]}
        times = tables[2][0]
        wanted = re.compile(task.pattern)
        names = dict.fromkeys(("time", *task.values, *(name for name in rows if wanted.fullmatch(name))))
        if missing := [name for name in names if name not in rows]:
            return SimulationResult(problem=f"the result has no `{missing[0]}`")
        series, parameters = dict[str, tuple[float, ...]](), dict[str, float]()
        for name in names:
            number, row = rows[name]
            numbers = math.copysign(1, row) * tables[number or 2][abs(row) - 1]
            if number == 1:
                parameters[name] = float(numbers[0])
                numbers = np.full(len(times), numbers[0])
            series[name] = tuple(numbers.tolist())
    except (OSError, ValueError, IndexError, KeyError, TypeError, MatReadError) as error:
        return SimulationResult(problem=f"the result can't be read: {error}")
    return SimulationResult(series, parameters=parameters)


def _package_files(job: CompileJob) -> list[Path]:
    """Return the files that load all packages of the roots; OpenModelica loads its own standard library."""
    files: list[Path] = []
    for root in map(Path, job.roots):
        whole = root if root.is_file() else root / "package.mo"
        files += [whole] if whole.is_file() else sorted([*root.glob("*/package.mo"), *root.glob("*.mo")])
    return [path for path in files if _library_name(path) not in STANDARD_LIBRARIES]


def _library_name(file: Path) -> str:
    return (file.parent.name if file.name == "package.mo" else file.stem).split(" ")[0]


def quoted(text: str) -> str:
    """Return a text as a literal of Modelica."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _text(literal: str) -> str:
    """Return the text of a literal of Modelica, which is given without quotes."""
    return _ESCAPED.sub(lambda match: _ESCAPES.get(match[1], match[1]), literal)
