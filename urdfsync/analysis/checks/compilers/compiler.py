"""Jobs of tasks for a Modelica compiler, and a result for each task."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Protocol, TypeAlias

import msgspec

from urdfsync.common.diagnostics import Diagnostic, UrdfsyncError

Series: TypeAlias = Mapping[str, Sequence[float]]
"""Numbers by variable; `time` is one of them."""


class Tool(msgspec.Struct, frozen=True):
    """A compiler that the user chose."""

    name: str = "rumoca"
    """A name in `compilers.COMPILERS`."""
    program: str = ""
    """The program to start, as a path or a name on the PATH; empty to search for the program."""
    problem: Diagnostic | None = None
    """Why the program may not be started; empty if this is allowed."""


class Simulation(msgspec.Struct, frozen=True):
    """One run from 0 to `stop` s with results every `step` s.

    `parameters` has new values for parameters of the compiled model, which is compiled once for several runs.
    """

    stop: float
    step: float
    parameters: Mapping[str, float] = {}
    tolerance: float | None = None
    """Relative and absolute tolerance of the integration; None leaves the choice to the compiler."""
    method: str = ""
    """A method in `Compiler.METHODS`; empty leaves the choice to the compiler."""


class Export(msgspec.Struct, frozen=True):
    """An FMU of a model."""

    version: str
    """The version of FMI: `2.0` or `3.0`."""
    kind: str
    """`me` (model exchange), `cs` (co-simulation) or `me_cs`."""


class CompileTask(msgspec.Struct, frozen=True):
    """A model in the text `source`, to compile and then to simulate for each of `runs`.

    If a compiler can't do a task, the problem of the result, or of each run, says so.
    """

    model: str
    source: str
    runs: tuple[Simulation, ...] = ()
    values: tuple[str, ...] = ()
    """Variables whose series each run returns."""
    pattern: str = ""
    """A regular expression for whole names: matching variables and parameters are returned as well."""
    parameters: tuple[str, ...] = ()
    """Parameters that the text sets. The task fails if the model lacks one of them, or if nothing depends on it."""
    varied: tuple[str, ...] = ()
    """Parameters to which `runs` give values. The task fails as for `parameters`, and for a structural parameter."""
    title: str = ""
    """The name of the model in messages."""
    export: Export | None = None
    """The FMU to export instead of a simulation; only OpenModelica can."""


class SimulationResult(msgspec.Struct, frozen=True):
    """A trajectory: a number per instant for `time` and for each value; or a problem."""

    values: Mapping[str, tuple[float, ...]] = {}
    problem: str = ""
    termination: str = ""
    """The model's message, if the model itself ended the simulation."""
    parameters: Mapping[str, float] = {}
    """The known values of parameters that `CompileTask.pattern` matches."""


class CompileResult(msgspec.Struct, frozen=True):
    """The answer to a task. A model that is not balanced does not compile."""

    problem: str = ""
    """Why the model does not compile, in the compiler's words; empty if the model compiles."""
    unknowns: int = 0
    """Number of scalar unknowns of the compiled model, which equals the number of equations."""
    warnings: str = ""
    """Findings about a model that compiles, in the compiler's words."""
    runs: tuple[SimulationResult, ...] = ()
    """A result for each run of the task, in order, unless there is a `problem`."""
    parameters: tuple[str, ...] | None = None
    """All parameters of the model, if it lacks a parameter that the task sets; else None."""
    without_effect: tuple[str, ...] = ()
    """Parameters that the task sets and on which nothing in the compiled model depends."""
    structural: tuple[str, ...] = ()
    """Parameters among `CompileTask.varied` that a compiled model can't change."""
    version: str = ""
    """The version that the compiler states."""
    fmu: bytes = b""


class CompileJob(msgspec.Struct, frozen=True):
    """Tasks for one process, one after the other."""

    roots: tuple[str, ...]
    """Files and folders of packages, and folders that hold packages: those of libraries and of the robot."""
    tasks: tuple[CompileTask, ...]
    program: str = ""
    """See `Tool.program`."""


class Complaint(msgspec.Struct, frozen=True):
    """One error or warning of a compiler."""

    message: str
    file: str = ""
    """The file as the compiler names it; empty without a file."""
    line: int = 0
    column: int = 0
    code: str = "does-not-compile"
    """Code of the diagnostic; any other code than the default is a warning."""


class CompilerError(UrdfsyncError):
    """A compiler is missing or broke down; the code of the only diagnostic tells which of the two."""


class Compiler(Protocol):
    """A module of this package that drives one compiler. `config.settings.CompilerName` lists the module's name."""

    TITLE: str
    """The name of the compiler in messages."""
    MODULES: tuple[str, ...]
    """The modules that have to be installed."""
    INSTALL: str
    """How to install the compiler, as a hint."""
    METHODS: tuple[str, ...]
    """Methods of integration."""
    HAS_STANDARD_LIBRARY: bool
    """Whether the compiler finds the Modelica Standard Library itself."""
    REUSES_MODELS: bool
    """Whether tasks of a job with the same text are compiled once, and runs may change parameters."""
    STARTS_PROGRAMS: bool
    """Whether the compiler lets models start programs. If so, the user has to trust a configuration that chooses it."""

    def program(self, named: str) -> str | None:
        """Return the path of the program to start; empty for a compiler without a program, None if it is missing.

        `named` is `Tool.program`.
        """
        ...

    def state(self, named: str) -> tuple[str, list[Path]]:
        """Return the stated version, and the compiler's files and folders with the libraries that it finds itself.

        The keys of results contain all of these. Requires an installed compiler. Raises OSError if the compiler does
        not answer.
        """
        ...

    def environment(self, cache: str, folder: str) -> dict[str, str]:
        """Return environment variables for the compiler; the folder `cache` stays, `folder` is temporary."""
        ...

    def work(self, job: CompileJob) -> Iterator[CompileResult]:
        """Do all tasks of a job in this process, in order. Raises ImportError if the compiler does not start."""
        ...

    def complaints(self, problem: str) -> list[Complaint]:
        """Return the complaints in the text of `CompileResult.problem`, in their order."""
        ...


def one_line(text: str) -> str:
    """Replace each run of blanks and line ends by one blank."""
    return " ".join(text.split())


def compile_task(model: str, libraries: Sequence[str] = ("Modelica", "UrdfSync")) -> CompileTask:
    """Compile a model of one of the roots, by its full name; `libraries` are the top-level packages that it needs.

    The text has to import each root, or rumoca does not load that root.
    """
    names = dict.fromkeys((*libraries, model.partition(".")[0]))
    imports = "".join(f"  import {name};\n" for name in names)
    return CompileTask("Probe_", f"model Probe_\n{imports}  extends {model};\nend Probe_;\n", title=model)
