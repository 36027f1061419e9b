"""A small arm to simulate, and a compiler that only remembers what it is asked."""

from __future__ import annotations

from collections.abc import Mapping

from support import urdfs
from urdfsync.checks.cache import UserCache
from urdfsync.checks.compilers.compiler import CompileJob, CompileResult, SimulationResult, Tool
from urdfsync.checks.process import Limits

ARM = urdfs.robot(
    *urdfs.links(base=None, upper=2.0, lower=1.0),
    urdfs.joint("shoulder", "revolute", "base", "upper", axis="0 1 0", inside=[urdfs.limit(-2, 2, 3, 50)]),
    urdfs.joint(
        "elbow",
        "revolute",
        "upper",
        "lower",
        axis="0 0 1",
        inside=[urdfs.limit(-1, 1.5, 4, 20), '<dynamics damping="0.5" friction="0.1"/>'],
    ),
    name="arm",
)


class Compiler:
    """In the place of `compilers.run_job`: gives the same result for each job, and keeps the jobs."""

    def __init__(self) -> None:
        self.jobs: list[CompileJob] = []
        self.results: list[CompileResult] = []
        self.values: Mapping[str, tuple[float, ...]] = {
            "time": (0.0, 1.0, 2.0),
            "robot.shoulder.revolute.phi": (0.0, 1.0, 2.5),
            "robot.shoulder.revolute.w": (0.0, 1.0, 0.0),
            "robot.shoulderAxis.tau": (0.0, 1.0, 0.0),
            "robot.elbow.revolute.phi": (0.0, 0.25, 0.5),
            "robot.elbow.revolute.w": (0.0, 0.0, 0.0),
        }
        limits = {"lower": -2.0, "upper": 2.0, "velocity": 3.0}
        self.parameters = {f"robot.shoulder.parameters.limits.{name}": limit for name, limit in limits.items()}

    def __call__(
        self, tool: Tool, job: CompileJob, cache: UserCache, limits: Limits, progress: object = None
    ) -> list[CompileResult]:
        """Return the next of the results, or the series."""
        self.jobs.append(job)
        run = SimulationResult(self.values, parameters=self.parameters)
        return [self.results.pop(0) if self.results else CompileResult(runs=(run,))]

    @property
    def source(self) -> str:
        """The text that was compiled last."""
        return self.jobs[-1].tasks[0].source
