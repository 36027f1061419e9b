"""A child process around the embedded compiler: a job as JSON on stdin, outcomes as JSON on stdout.

A process of its own, because the compiler takes gigabytes for large robots and keeps them, and because
a crash of it must not end the tests.
"""

from __future__ import annotations

import json
import os
import resource
import sys
import time
from pathlib import Path
from typing import Any

import rumoca

from support.slim import slim_library


def main() -> None:
    """Do all tasks with one session, in order."""
    with os.fdopen(os.dup(sys.stdout.fileno()), "w") as answer:
        os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # what the compiler may say is not the answer
        job = json.load(sys.stdin)
        session = rumoca.Session(roots=[str(slim_library(Path(job["library"]))), *job["roots"]])
        json.dump([_done(session, task) for task in job["tasks"]], answer)


def _done(session: Any, task: dict[str, Any]) -> dict[str, Any]:
    started = time.process_time()
    outcome: dict[str, Any] = {"error": "", "summary": "", "runs": []}
    try:
        model = session.loads(task["source"], model=task["model"], filename="Task.mo")
    except rumoca.RumocaError as error:
        outcome["error"] = f"{type(error).__name__}: {error}"
    else:
        outcome["summary"] = str(model.summary())
        outcome["load_seconds"] = time.process_time() - started
        outcome["runs"] = [_run(model, run, task["values"]) for run in task["runs"]]
    outcome["seconds"] = time.process_time() - started
    outcome["megabytes"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return outcome


def _run(model: Any, run: dict[str, Any], values: list[str]) -> dict[str, Any]:
    try:
        result = model.simulate(
            (0, run["stop"]), config=rumoca.SimConfig(dt=run["step"]), params=run["parameters"] or None
        )
    except rumoca.RumocaError as error:
        return {"error": f"{type(error).__name__}: {error}", "times": [], "values": {}}
    series = {name: [float(value) for value in result[name]] for name in values}
    return {"error": "", "times": list(map(float, result.time)), "values": series}


if __name__ == "__main__":
    main()
