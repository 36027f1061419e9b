"""Fuzzing as a command: `python tests/fuzz.py state|config COUNT [--seed S] [--jobs J]`.

Each case is a random hostile input, and must end without a traceback, without a change outside of its project, without
a hang and without the loss of an edit. A finding is printed with the seed of its case; `COUNT` 1 with that seed
repeats it. Exit code 1 if there is any.

Works in processes of their own with a home folder and a folder for temporary files of their own, so that a case which
crashes Python or hangs in a library is a finding, too, and the next cases go on.
"""

from __future__ import annotations

import argparse
import concurrent.futures
import importlib
import os
import subprocess
import sys
import tempfile
from pathlib import Path

KINDS = {"state": "fuzzing.state", "config": "fuzzing.config"}
_LAST_SEED = "last-seed"
_FOUND = 3
"""Exit code of a worker that found faults; any other but 0 means that a case ended the process, by a time limit say."""


def main() -> int:
    """Run the cases, in as many processes as asked for; 1 if there is any finding."""
    parser = argparse.ArgumentParser(description="Fuzz urdfsync.")
    parser.add_argument("kind", choices=KINDS)
    parser.add_argument("count", type=int)
    parser.add_argument("--seed", type=int, default=1, help="of the first case; each next one has the next number")
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    parser.add_argument("--worker", action="store_true", help=argparse.SUPPRESS)
    args = parser.parse_args()
    if args.worker:
        return _FOUND if importlib.import_module(KINDS[args.kind]).run(args.count, args.seed) else 0
    share, rest = divmod(args.count, args.jobs)
    counts = [share + (number < rest) for number in range(args.jobs)]
    seeds = [args.seed + sum(counts[:number]) for number in range(args.jobs)]
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        found = list(pool.map(_run_worker, [args.kind] * args.jobs, counts, seeds))
    return int(any(found))


def _run_worker(kind: str, count: int, seed: int) -> bool:
    """Run cases in a process; another one goes on after a case that ended it. Returns whether there are findings."""
    found, end = False, seed + count
    while seed < end:
        with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
            command = [sys.executable, __file__, kind, str(end - seed), "--seed", str(seed), "--worker"]
            code = subprocess.run(command, cwd=folder, env=_environment(Path(folder)), check=False).returncode
            found |= code != 0
            if code in (0, _FOUND):
                break
            last = Path(folder, _LAST_SEED)
            seed = int(last.read_text().split()[0]) if last.exists() else end
            print(f"{kind}, seed {seed}: the process ended with {code}", flush=True)  # noqa: T201
            seed += 1
    return found


def _environment(folder: Path) -> dict[str, str]:
    """The environment of a worker, whose home and whose temporary files are in its folder."""
    places = {"HOME": folder / "home", "TMPDIR": folder / "tmp"}
    for place in places.values():
        place.mkdir()
    own = {name: value for name, value in os.environ.items() if not name.startswith("XDG_")}
    return own | {name: str(place) for name, place in places.items()}


if __name__ == "__main__":
    sys.exit(main())
