"""Who may know whom: the last column of the table in the design, read from the imports."""

from __future__ import annotations

import ast
import functools
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

import urdfsync

PACKAGE = Path(urdfsync.__file__).parent
OURS = sorted(path.relative_to(PACKAGE).with_suffix("").as_posix() for path in PACKAGE.rglob("*.py"))
MODULES = [name for name in OURS if not name.endswith("__init__") and not name.startswith("_data")]

IO = ("os", "io", "shutil", "subprocess", "tempfile", "socket", "glob", "urllib.request", "sys")
HEAVY = ("jinja2", "rich", "lxml", "yourdfpy", "trimesh", "numpy", "collada", "deepdiff", "rumoca", "watchdog")
EXTRAS = ("psutil", "platformdirs", "pinocchio", "OMPython")
"""Of the optional extras, beside rumoca."""
SHELL = (
    *(
        "build",
        "planning",
        "config",
        "cli",
        "watch.daemon",
        "report",
        "files",
        "init",
        "commands",
        "views",
        "state",
        "records",
        "standalone",
    ),
    *(f"comparing.{name}" for name in ("differ", "versions", "revisions", "subjects")),
    *(f"staging.{name}" for name in ("staged", "mirror", "worktree", "judging", "committing")),
    "hook",
)
SHELL_MODULES = tuple(f"urdfsync.{name}" for name in SHELL)

FORBIDDEN: dict[str, tuple[str, ...]] = {
    "diagnostics": ("urdfsync", *IO, *HEAVY),
    "dependencies": ("urdfsync", *HEAVY),
    "profiling": ("urdfsync", "pathlib", *(name for name in IO if name != "sys"), *HEAVY),
    "domain": ("urdfsync.urdf", "urdfsync.render", "urdfsync.registry", *SHELL_MODULES, *IO, *HEAVY),
    "changes": ("rich", "pathlib", "jinja2", "urdfsync.urdf", *IO, *SHELL_MODULES),
    "difference": ("pathlib", *IO, *HEAVY, *SHELL_MODULES),
    "render": ("urdfsync.urdf", "urdfsync.manifest", "rich", *SHELL_MODULES),
    "manifest": ("rich", "pathlib", *IO, *SHELL_MODULES),
    "modelfile": ("rich", "pathlib", *IO, *SHELL_MODULES),
    "plan": ("pathlib", "urdfsync.manifest", "urdfsync.registry", "urdfsync.urdf", *SHELL_MODULES, *IO, *HEAVY),
    "order": ("urdfsync", "pathlib", *IO, *HEAVY),
    "shelf": ("urdfsync", "pathlib", *IO, *HEAVY),
    "moves": ("pathlib", *IO, *HEAVY, *SHELL_MODULES),
    "outcome": (*SHELL_MODULES, *IO, *HEAVY),
    "status": ("pathlib", "urdfsync.manifest", "urdfsync.urdf", *SHELL_MODULES, *IO, *HEAVY),
    "records": ("urdfsync.build", "urdfsync.report", "urdfsync.cli", *HEAVY),
    "standalone": ("urdfsync.build", "urdfsync.report", "urdfsync.cli", *HEAVY),
    "resolution": (*SHELL_MODULES, *HEAVY),
    "comparing/comparison": ("pathlib", "urdfsync.manifest", "urdfsync.urdf", *SHELL_MODULES, *IO, *HEAVY),
    "comparing/figures": ("urdfsync", "pathlib", *IO, *HEAVY),
    "comparing/outline": ("pathlib", "urdfsync.manifest", "urdfsync.urdf", *SHELL_MODULES, *IO, *HEAVY),
    "comparing/revisions": ("urdfsync.manifest", "urdfsync.build", "urdfsync.report", "urdfsync.cli", *HEAVY),
    "comparing/subjects": ("urdfsync.manifest", "urdfsync.build", "urdfsync.report", "urdfsync.cli", *HEAVY),
    "comparing/versions": ("urdfsync.build", "urdfsync.report", "urdfsync.cli", *HEAVY),
    "comparing/differ": ("urdfsync.report", "urdfsync.cli", "urdfsync.render", *HEAVY),
    "wording": (*SHELL_MODULES, *IO, *HEAVY),
    "documents": (*SHELL_MODULES, *IO, *HEAVY),
    **{f"modelica/{name}": ("urdfsync", *IO, *HEAVY) for name in ("names", "literals")},
    **{
        f"modelica/{name}": ("pathlib", "urdfsync.manifest", "urdfsync.merging", *SHELL_MODULES, *IO, *HEAVY)
        for name in ("lexer", "syntax", "reader", "expressions", "parser", "scopes", "unresolved")
    },
    "merge": ("pathlib", *SHELL_MODULES, *IO, *HEAVY),
    "merging/soundness": ("pathlib", "urdfsync.manifest", *SHELL_MODULES, *IO, *HEAVY),
    "tomlfile": ("pathlib", *SHELL_MODULES, *IO, *HEAVY),
    "tables": ("pathlib", *SHELL_MODULES, *IO, *HEAVY),
    "targets": ("pathlib", *SHELL_MODULES, *IO, *HEAVY),
    "build": ("rich", "watchdog", "urdfsync.report", "urdfsync.cli"),
    "planning/planner": ("rich", "watchdog", "urdfsync.report", "urdfsync.cli"),
    "state/journal": ("pathlib", "urdfsync", *IO, *HEAVY),
    "state/operations": ("urdfsync.build", "urdfsync.config", "urdfsync.manifest", *HEAVY),
    "state/batch": ("urdfsync.build", "urdfsync.config", "urdfsync.manifest", *HEAVY),
    "state/transactions": ("urdfsync.build", "urdfsync.config", "urdfsync.manifest", *HEAVY),
    "state/lock": ("urdfsync.build", "urdfsync.config", "urdfsync.manifest", *HEAVY),
    "state/repair": ("pathlib", *SHELL_MODULES, *IO, *HEAVY),
    "planning/memory": ("pathlib", "urdfsync.build", "urdfsync.config", "urdfsync.urdf", *IO, *HEAVY),
    "spelling": ("urdfsync", "pathlib", *IO, *HEAVY),
    "planning/decide": ("rich", "watchdog", "urdfsync.build", "urdfsync.report", "urdfsync.cli"),
    "planning/disk": ("urdfsync.manifest", "urdfsync.build", "urdfsync.report", "urdfsync.cli", *HEAVY),
    "staging/staged": (
        "urdfsync.build",
        "urdfsync.config",
        "urdfsync.manifest",
        "urdfsync.report",
        "urdfsync.cli",
        *HEAVY,
    ),
    "staging/mirror": ("urdfsync.build", "urdfsync.manifest", "urdfsync.report", "urdfsync.cli", *HEAVY),
    "staging/verdict": (*SHELL_MODULES, *IO, *HEAVY),
    "staging/worktree": ("urdfsync.build", "urdfsync.report", "urdfsync.cli", *HEAVY),
    "staging/judging": ("urdfsync.report", "urdfsync.cli", *HEAVY),
    "config": ("urdfsync.build", "urdfsync.report", "urdfsync.cli", *HEAVY),
    "watch/events": ("watchdog", "rich", *IO),
    **{f"watch/{name}": ("pathlib", *SHELL_MODULES, *IO, *HEAVY) for name in ("status", "summary")},
    "watch/debounce": ("urdfsync", "pathlib", "time", *IO, *HEAVY),
    **{
        f"watch/{name}": ("rich", "watchdog", "urdfsync.report", "urdfsync.views", "urdfsync.cli")
        for name in ("build", "checks", "event_queue", "exec", "input_files", "paths", "precommit", "robots")
    },
    "watch/daemon": ("rich", "urdfsync.urdf", "urdfsync.report", "urdfsync.views", "urdfsync.cli"),
    "checking/verdict": ("pathlib", *SHELL_MODULES, *IO, *HEAVY),
    "checking/words": ("pathlib", *SHELL_MODULES, *IO, *HEAVY),
    "checking/cache": (*(name for name in SHELL_MODULES if name != "urdfsync.state"), *HEAVY),
    "checking/libraries/dependencies": ("urdfsync.build", "urdfsync.report", "urdfsync.cli", *HEAVY, *EXTRAS),
    **{
        f"checking/compilers/{name}": ("pathlib", *SHELL_MODULES, *IO, *HEAVY, *EXTRAS)
        for name in ("compiler", "rumoca")
    },
    "checking/libraries/library": (*SHELL_MODULES, *HEAVY, *EXTRAS),
    "checking/process": ("urdfsync", *HEAVY),
    "checking/libraries/references": ("urdfsync", "pathlib", *IO, *HEAVY, *EXTRAS),
    "checking/libraries/slim": (*SHELL_MODULES, *HEAVY, *EXTRAS),
    "checking/compilers/worker": (
        *SHELL_MODULES,
        *("jinja2", "rich", "lxml", "yourdfpy", "trimesh", "numpy", "collada", "deepdiff", "watchdog"),
    ),
    **{
        f"checking/diagnosis/{name}": ("urdfsync.manifest", *SHELL_MODULES, *IO, *HEAVY, *EXTRAS)
        for name in ("package", "complaints", "mentions", "problems")
    },
    "checking/diagnosis/layout": (
        "urdfsync.manifest",
        "urdfsync.build",
        "urdfsync.report",
        "urdfsync.cli",
        *IO,
        *HEAVY,
        *EXTRAS,
    ),
    "checking/compilers/omc": ("urdfsync.build", "urdfsync.report", "urdfsync.cli", *HEAVY, *EXTRAS),
    "checking/memory": ("urdfsync.build", "urdfsync.report", "urdfsync.cli", *HEAVY),
    "checking/afterbuild": ("urdfsync.build", "urdfsync.report", "urdfsync.cli", *HEAVY),
    "watch/observer": ("rich", "urdfsync.build", "urdfsync.report", "urdfsync.views", "urdfsync.cli"),
    "check": ("rich",),
    "report": ("urdfsync.build", "urdfsync.cli", "urdfsync.urdf"),
    **{
        f"views/{name}": ("urdfsync.build", "urdfsync.cli", "urdfsync.urdf")
        for name in (
            *("builds", "comparisons", "conflicts", "drafts", "hunks", "statuses"),
            *("checks", "profiles", "terminal"),
        )
    },
    "views/hooks": ("urdfsync.build", "urdfsync.cli", "urdfsync.urdf", *HEAVY),
    "cli": ("jinja2", "deepdiff", "urdfsync.urdf", "rich"),
    "urdf/robot": ("lxml", "yourdfpy", "numpy", "pathlib", *IO),
    "urdf/parse/source": ("jinja2", "urdfsync.render", "urdfsync.manifest", *SHELL_MODULES),
    "urdf/names": ("pathlib", *IO, *HEAVY, *SHELL_MODULES),
    "urdf/validate": ("lxml", "pathlib", *IO, *HEAVY, *SHELL_MODULES),
    "urdf/artifacts": ("jinja2", "pathlib", *IO, *SHELL_MODULES),
}
"""Per module: what it must not import, at whatever place in the file."""

LIGHT = (
    "cli",
    "dependencies",
    "config",
    "registry",
    "build",
    "planning/planner",
    "state/transactions",
    "state/lock",
    "report",
    "manifest",
    "modelfile",
    "plan",
    "state/store",
    "urdf/domain",
    *(f"commands/{name}" for name in ("build", "hook", "init", "library")),
    "commands/diff",
    "commands/status",
    "commands/resolve",
    "commands/watch",
    "commands/check",
    "commands/record",
    "checking/afterbuild",
    "checking/cache",
    *(f"checking/compilers/{name}" for name in ("choice", "compiler", "rumoca")),
    "checking/libraries/dependencies",
    "checking/memory",
    "checking/libraries/slim",
)
"""Modules on the way of a build that has nothing to do: no heavy library, not even through others."""

FIRST = (*("__main__", "hook", "uptodate", "dependencies", "streams", "staging/listing"),)
"""What is loaded before anybody knows that there is something to do."""
AT_ONCE = {"__future__", "collections.abc", "contextlib", "contextvars", "errno", "os", "stat", "sys", "time"}
"""Modules of Python's that take no time to load, or have been loaded at its start."""

NO_IO_CALLS = {
    "open", "read_text", "read_bytes", "write_text", "write_bytes", "mkdir", "unlink", "rmdir", "touch", "iterdir",
    "rglob", "exists", "is_file", "is_dir", "stat", "lstat", "resolve", "cwd", "home", "symlink_to",
}  # fmt: skip
PURE = (
    *(
        "changes",
        "comparing/comparison",
        "comparing/outline",
        "comparing/figures",
        "diagnostics",
        "difference",
        "domain",
        "manifest",
        "modelfile",
        "plan",
        "order",
        "shelf",
        "outcome",
        "spelling",
        "resolution",
        "status",
        "wording",
        "documents",
        "checking/libraries/references",
        "checking/verdict",
        "checking/words",
        "watch/status",
        "watch/summary",
        *(f"checking/diagnosis/{name}" for name in ("package", "layout", "complaints", "mentions", "problems")),
    ),
    *(
        name
        for name in MODULES
        if name in ("merge", "state/repair") or name.startswith(("urdf/", "merging/", "modelica/"))
    ),
)


@functools.cache
def tree(module: str) -> ast.Module:
    return ast.parse((PACKAGE / f"{module}.py").read_text(encoding="utf-8"))


def imports(node: ast.AST) -> Iterator[str]:
    """Full names of what an import statement brings in."""
    if isinstance(node, ast.Import):
        yield from (alias.name for alias in node.names)
    elif isinstance(node, ast.ImportFrom):
        assert not node.level, "imports are absolute"
        yield from (f"{node.module}.{alias.name}" for alias in node.names)


def all_imports(module: str) -> set[str]:
    return {name for node in ast.walk(tree(module)) for name in imports(node)}


@functools.cache
def loaded_with(module: str) -> frozenset[str]:
    """What importing a module imports, through our other modules as well; imports inside functions do not count."""
    seen: set[str] = set()
    waiting = [module]
    while waiting:
        for node in _executed(tree(waiting.pop())):
            for name in set(imports(node)) - seen:
                seen.add(name)
                ours = name.removeprefix("urdfsync.").replace(".", "/")
                waiting += [m for m in MODULES if name.startswith("urdfsync.") and m in (ours, ours.rpartition("/")[0])]
    return frozenset(seen)


def _executed(module: ast.Module) -> Iterator[ast.AST]:
    waiting: list[ast.AST] = [module]
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            continue
        if isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING":
            continue
        yield node
        waiting += ast.iter_child_nodes(node)


def broken(found: set[str] | frozenset[str], forbidden: tuple[str, ...]) -> list[str]:
    return sorted(name for name in found for rule in forbidden if name == rule or name.startswith(f"{rule}."))


@pytest.mark.parametrize("module", sorted(FORBIDDEN.keys() & set(MODULES)))
def test_no_module_knows_what_it_must_not(module: str) -> None:
    assert broken(all_imports(module), FORBIDDEN[module]) == []


@pytest.mark.parametrize("module", [m for m in MODULES if not m.startswith("urdf/")])
def test_the_core_knows_no_domain(module: str) -> None:
    assert broken(all_imports(module), ("urdfsync.urdf",)) == []


@pytest.mark.parametrize("module", [m for m in MODULES if m.startswith("urdf/")])
def test_the_domain_knows_the_contract_only(module: str) -> None:
    assert broken(all_imports(module), (*SHELL_MODULES, "urdfsync.plan", "urdfsync.manifest", "rich", "jinja2")) == []


@pytest.mark.parametrize("module", [m for m in MODULES if m != "report" and not m.startswith(("views/", "watch/"))])
def test_only_the_report_knows_rich(module: str) -> None:
    assert broken(all_imports(module), ("rich",)) == []


@pytest.mark.parametrize("module", LIGHT)
def test_a_build_with_nothing_to_do_stays_light(module: str) -> None:
    assert broken(loaded_with(module), (*HEAVY, *EXTRAS)) == []


@pytest.mark.parametrize("module", FIRST)
def test_what_is_loaded_first_needs_next_to_nothing(module: str) -> None:
    allowed = {*AT_ONCE, "urdfsync.__version__", *(f"urdfsync.{name.replace('/', '.')}" for name in FIRST)}
    assert {name for name in loaded_with(module) if not {name, name.rpartition(".")[0]} & allowed} == set()


@pytest.mark.parametrize("module", PURE)
def test_pure_modules_touch_no_files(module: str) -> None:
    calls = [node.func for node in ast.walk(tree(module)) if isinstance(node, ast.Call)]
    names = {call.attr if isinstance(call, ast.Attribute) else getattr(call, "id", "") for call in calls}
    assert names & NO_IO_CALLS == set()


@pytest.mark.parametrize("module", MODULES)
def test_values_are_structs(module: str) -> None:
    assert broken(all_imports(module), ("dataclasses",)) == []


@pytest.mark.parametrize("module", MODULES)
def test_imports_name_what_the_project_depends_on(module: str) -> None:
    known = {*sys.stdlib_module_names, "urdfsync", "msgspec", "tomli", "tomli_w", *HEAVY, *EXTRAS}
    assert {name.partition(".")[0] for name in all_imports(module)} <= known


def test_the_rules_bite() -> None:
    assert broken(loaded_with("planning/generate"), ("jinja2",)) == [], "imports inside functions are not run"
    assert "jinja2" in all_imports("planning/generate")
    assert "jinja2" in loaded_with("render")
    assert "urdfsync.plan.FileRecord" in loaded_with("build"), "through `manifest`"
