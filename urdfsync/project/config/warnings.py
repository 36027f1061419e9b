"""Warns of keys without effect before the work, once for all robots."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from urdfsync.common.dependencies.reads import file_type, is_folder, read_file, walk_files
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.files import shown
from urdfsync.common.spelling import nearest
from urdfsync.domain import registry
from urdfsync.project.config.paths import templates_folder
from urdfsync.project.config.settings import Config, RobotConfig

_SUFFIX = ".jinja"


def find_warnings(config: Config, robots: Sequence[RobotConfig]) -> tuple[Diagnostic, ...]:
    """Find missing search paths, and files in template folders that no template uses or replaces."""
    warnings = (warning for robot in robots for warning in robot.without_ignored(_find_warnings(config, robot)))
    return tuple(dict.fromkeys(warnings))


def _find_warnings(config: Config, robot: RobotConfig) -> Iterator[Diagnostic]:
    missing = [("package_paths", "the folder ", path) for path in robot.package_paths if not is_folder(path)]
    missing += [("users", "", path) for path in robot.users if not file_type(path)]
    for key, noun, path in missing:
        message, line = f"{noun}{shown(path)} of `{key}` does not exist", robot.lines.get(key, 0)
        code, hint = "no-package-path" if key == "package_paths" else "no-users-path", "correct it, or take it out"
        yield Diagnostic(Severity.WARNING, code, message, shown(config.file), line, hint=hint)
    domain = registry.domain(robot.domain)
    if robot.templates is None or not is_folder(robot.templates) or domain.starter:
        return  # templates of a domain with a starter are the user's
    templates = set(_files(templates_folder(domain)))
    own = _files(robot.templates)
    for name in sorted(own.keys() - templates):
        replaces = name if name.endswith(_SUFFIX) else f"{name}{_SUFFIX}"
        if replaces != name and replaces not in templates:
            continue  # an unused file
        if any(name.encode() in read_file(path) for other, path in own.items() if other != name):
            continue
        near = nearest(replaces, sorted(templates), 0.5)
        hint = f"did you mean `{near}`?" if near else f"rename it to one of {', '.join(sorted(templates))}"
        message = "the file replaces no template: urdfsync has none of this name"
        yield Diagnostic(Severity.WARNING, "stray-template", message, shown(own[name]), hint=hint)


def _files(folder: Path) -> dict[str, Path]:
    """Return the files below a folder, except hidden ones, by their POSIX paths in the folder."""
    files = {path.relative_to(folder): path for path in map(Path, walk_files(folder))}
    return {
        name.as_posix(): path for name, path in files.items() if not any(part.startswith(".") for part in name.parts)
    }
