"""All checks of the project: `python -m tests [--long|--all] [--part N/M] [--tests] [pytest arguments]`.

`--long` adds the tests that take more than a few seconds, as in CI; `--all` adds the large ones, too. `--part 2/4` runs
a quarter of what one of the two adds. `--tests`, for a further Python, leaves out the linter and the tests whose result
does not depend on the Python.

Three options check nothing of this machine: `--renew` writes the golden files anew, which templates and library write
(tests/support/golden.py), and the forms and projects of tests/kept; `--map [ROOM]` prints what each module of urdfsync
holds, by the first line of its docstring; `--windows FOLDER` runs tests with the Windows Python that FOLDER/python
starts (support/windows.py), or those that further arguments of pytest name.
"""

import ast
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]

# one more process than cores, since tests that watch folders mostly wait
PYTEST = ["pytest", "-n", str((os.cpu_count() or 1) + 1), "--dist", "worksteal", "-m"]
STATIC = {
    "lint": ["ruff", "check", "."],
    "format": ["ruff", "format", "--check", "."],
    "types": ["mypy"],
    "types on Windows": ["mypy", "--platform", "win32", "urdfsync"],
    "imports": ["lint-imports", "--no-cache"],
}
EXAMPLES = {"examples in step": ["urdfsync", "build", "--check"]}
QUICK = {"tests": [*PYTEST, "not slow and not large"]}
ONE_MORE = {"tests": [*PYTEST, "not slow and not large and not once"]}
# in one run with the other tests: each process takes 13 s to find all tests
LONG = {"tests": [*PYTEST, "not large"]}
ALL = {"tests": [*PYTEST, ""]}
OPTIONS = ("--long", "--all", "--tests")
# one thread, large pieces of memory: rumoca takes a quarter of its time for locks and for freeing memory
COMPILER = {"RAYON_NUM_THREADS": "1", "MALLOC_ARENA_MAX": "1", "MALLOC_TOP_PAD_": str(2**26)}


def main() -> int:
    """Run every check, even after one has failed; the exit code is 1 if any did."""
    failed, types = list[str](), None
    # without bytecode on disk, thousands of processes compile all modules, which takes three quarters of their time
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    environment |= COMPILER
    if {"-h", "--help"} & {*sys.argv}:
        print(__doc__, end="")  # noqa: T201
        return 0
    if "--map" in sys.argv:
        return print_map(*sys.argv[sys.argv.index("--map") + 1 :][:1])
    if sys.argv[1:2] == ["--windows"]:
        sys.path.insert(0, str(ROOT / "tests"))
        from support import windows

        return windows.run(Path(sys.argv[2]).resolve(), sys.argv[3:])
    given = [argument for argument in sys.argv[1:] if argument not in OPTIONS]
    if "--renew" in sys.argv:
        own = {"PYTHONPATH": str(ROOT / "tests")}
        return subprocess.run(
            [sys.executable, "-m", "support.renew"], cwd=ROOT, env=environment | own, check=False
        ).returncode
    if "--tests" in sys.argv:
        checks = EXAMPLES | ONE_MORE
    else:
        checks = STATIC | EXAMPLES | (ALL if "--all" in sys.argv else LONG if "--long" in sys.argv else QUICK)
    for name, (module, *arguments) in checks.items():
        print(f"== {name}", flush=True)  # noqa: T201
        extra = given if module == "pytest" else []
        command = [sys.executable, "-m", module]
        if module == "lint-imports":  # which is no module
            command = [str(Path(sys.executable).with_name(module))]
        if name == "types":  # takes a minute on one core, which later tests leave now and then
            types = subprocess.Popen([*command, *arguments], cwd=ROOT, env=environment, stdout=subprocess.PIPE)
        elif subprocess.run([*command, *arguments, *extra], cwd=ROOT, env=environment, check=False).returncode:
            failed.append(name)
    if types:
        print(f"types: {types.communicate()[0].decode()}", flush=True)  # noqa: T201
        failed += ["types"] * bool(types.returncode)
    print(f"failed: {', '.join(failed)}" if failed else "all checks passed", flush=True)  # noqa: T201
    return 1 if failed else 0


def print_map(room: str = "") -> int:
    """Print the first lines of the docstrings of all modules below a room."""
    top = ROOT / "urdfsync"
    for file in sorted(top.joinpath(room).rglob("*.py")):
        first = (ast.get_docstring(ast.parse(file.read_text(encoding="utf-8"))) or "").partition("\n")[0]
        name = file.relative_to(top).with_suffix("").as_posix().removesuffix("/__init__")
        print(f"{name:<40} {first}")  # noqa: T201
    return 0


if __name__ == "__main__":
    sys.exit(main())
