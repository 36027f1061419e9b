"""What a Modelica compiler is asked and what it answers, as plain data that travels between processes."""

from __future__ import annotations

from collections.abc import Mapping

import msgspec


class Simulation(msgspec.Struct, frozen=True):
    """One run from 0 to `stop` s with results every `step` s; `parameters` get other values than in the text."""

    stop: float
    step: float
    parameters: Mapping[str, float] = {}
    tolerance: float | None = None
    """Of the integration, relative and absolute; None leaves it to the compiler."""


class Task(msgspec.Struct, frozen=True):
    """A model to compile, which is in the text `source`; then to simulate, if there are `runs`."""

    model: str
    source: str
    runs: tuple[Simulation, ...] = ()
    values: tuple[str, ...] = ()
    """Variables of which each run hands back a series."""
    name: str = ""
    """What messages call the model, if not `model`."""

    @property
    def title(self) -> str:
        """What messages call the model."""
        return self.name or self.model


class Series(msgspec.Struct, frozen=True):
    """What a run gave: what went wrong, or a number per instant for `time` and for each value."""

    values: Mapping[str, tuple[float, ...]] = {}
    problem: str = ""


class Outcome(msgspec.Struct, frozen=True):
    """What became of a task. A model that is not balanced does not compile."""

    problem: str = ""
    """What the compiler says of a model that does not compile, in its words; empty if it does."""
    unknowns: int = 0
    """Scalar unknowns of the compiled model; so many equations as well."""
    states: int = 0
    """Scalar states, as the compiler counts them before it reduces the index."""
    runs: tuple[Series, ...] = ()
    seconds: float = 0.0
    """CPU time of the task."""
    compiling: float = 0.0
    """The part of it before the first run."""
    megabytes: float = 0.0
    """Peak memory of the process so far."""


class Job(msgspec.Struct, frozen=True):
    """Tasks for one process, one after the other, with the libraries in the folders `roots`."""

    roots: tuple[str, ...]
    tasks: tuple[Task, ...]


def compiling(model: str, libraries: tuple[str, ...] = ("Modelica", "UrdfSync")) -> Task:
    """Compile a model of one of the roots, by its full name; `libraries` are the top-level packages that it needs.

    The text has to name each root in an import, or the compiler does not load it.
    """
    names = dict.fromkeys((*libraries, model.partition(".")[0]))
    imports = "".join(f"  import {name};\n" for name in names)
    return Task("Probe_", f"model Probe_\n{imports}  extends {model};\nend Probe_;\n", name=model)
