"""The packages around a generated package, and their `package.order` files.

Missing packages are made only with `create_parents`. A `package.order` must name every class of its package. Only a
Modelica parser finds the classes inside of a `package.mo`. So urdfsync adds its names to an existing `package.order`,
and makes a `package.order` only together with a new package.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from pathlib import Path

import msgspec

from urdfsync.common.dependencies.reads import file_type, is_file, is_folder, read_file
from urdfsync.common.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.common.files import shown
from urdfsync.modelica.names import LIBRARY, within
from urdfsync.project.config import Config, RobotConfig


class SharedFile(msgspec.Struct, frozen=True):
    """A `package.mo` or a `package.order` around the package; other robots may share it.

    A build reads the file again before it writes, so robots of one parent package can be planned at once.
    """

    path: Path
    content: bytes | None = None
    """Content of a missing `package.mo`; None for a `package.order`."""
    names: tuple[str, ...] = ()
    """Required lines of a `package.order`."""
    owned: tuple[str, ...] = ()
    """Lines of a `package.order` that urdfsync may remove."""
    joins: bool = False
    """Whether both sides of git's merge of a `package.order` stay."""


class Parents(msgspec.Struct, frozen=True):
    """The files to write in the packages around a robot's package."""

    shared: tuple[SharedFile, ...] = ()
    """The files of missing packages, and the `package.order` files that have to name these packages."""
    listed: bool = True
    """Whether an existing or new `package.order` of the parent has to name the robot's package."""
    diagnostics: tuple[Diagnostic, ...] = ()


def check(config: Config, robot: RobotConfig, uses: Sequence[tuple[str, str]]) -> Parents:
    """Check the output folder and all parents of the robot's package; `uses` are the libraries that the package needs.

    Raises OutputError at the line of the configuration if the package can't be there.
    """
    if is_file(robot.output / "package.mo"):
        message = f"the output folder {shown(robot.output)} is a Modelica package itself"
        hint = "name the folder above it as output, and the package with its full name"
        raise _refusal(config, robot, "output-is-package", message, hint, "output")
    existing = next(folder for folder in (robot.output, *robot.output.parents) if file_type(folder, follow=False))
    if not is_folder(existing):
        message = f"the output folder {shown(robot.output)} can't be created: {shown(existing)} is not a folder"
        raise _refusal(config, robot, "output-is-file", message, "name another folder", "output")
    if existing != robot.output and config.root not in robot.output.parents:
        message = f"the output folder {shown(robot.output)} does not exist"
        hint = "create it: urdfsync creates folders only beside or below its configuration"
        raise _refusal(config, robot, "no-output", message, hint, "output")
    output, parts, missing = robot.output, robot.target.package.split("."), list[Path]()
    if parts[0] == LIBRARY and not is_file(output / LIBRARY / "package.mo"):  # hides the library
        message = f"`{LIBRARY}` is the library that models need; a package of that name would hide it"
        raise _refusal(config, robot, "modelica-name", message, f"choose another top-level package than `{LIBRARY}`")
    for depth in range(1, len(parts) + 1):
        folder, name = output.joinpath(*parts[:depth]), ".".join(parts[:depth])
        single = folder.with_name(f"{folder.name}.mo")
        if is_file(single):
            message = f"package `{name}` is the single file {shown(single)}; it must be a folder with a package.mo"
            raise _refusal(config, robot, "package-is-file", message, "turn it into a folder, or move it away")
        if depth < len(parts) and not is_file(folder / "package.mo"):
            missing.append(folder)
            if not robot.create_parents:
                message = f"the parent package `{name}` does not exist in {shown(output)}"
                hint = "create it, or set `create_parents = true`"
                raise _refusal(config, robot, "no-parent", message, hint)

    def is_ordered(package: Path) -> bool:
        """Whether a package has a `package.order`, or urdfsync makes the package with one."""
        return package in missing or is_file(package / "package.order")

    shared = []
    for folder in missing:
        annotation = f"  annotation ({_uses(uses)});\n" if folder.parent == output else ""
        clause = within(".".join(folder.relative_to(output).parts))
        text = f'{clause}\npackage {folder.name} "{folder.name}"\n{annotation}end {folder.name};\n'
        shared.append(SharedFile(folder / "package.mo", text.encode()))
        if folder.parent != output and is_ordered(folder.parent):
            shared.append(SharedFile(folder.parent / "package.order", None, (folder.name,)))
    findings = _read_missing_uses(output / parts[0] / "package.mo", uses) if len(parts) > 1 else ()
    return Parents(tuple(shared), is_ordered(robot.folder.parent), findings)


def _refusal(
    config: Config, robot: RobotConfig, code: str, message: str, hint: str, key: str = "package"
) -> OutputError:
    line, message = robot.lines.get(key, robot.lines[""]), f"robot `{robot.name}`: {message}"
    return OutputError.of(code, message, shown(config.file), line, hint=hint)


def _read_missing_uses(top: Path, uses: Sequence[tuple[str, str]]) -> tuple[Diagnostic, ...]:
    """Return a warning if libraries are missing in the `uses` annotation of the user's top-level `package.mo`."""
    name, text = top.parent.name, read_file(top).decode(errors="replace") if is_file(top) else None
    if text is None:
        return ()
    missing = [use for use in uses if use[0] != name and not re.search(rf"\b{use[0]}\s*\(\s*version", text)]
    if not missing:
        return ()
    message = f"package `{name}` does not say that it needs {' and '.join(library for library, _ in missing)}"
    hint = f"add `{_uses(missing)}` to its annotation"
    return (Diagnostic(Severity.WARNING, "no-uses", message, shown(top), hint=hint),)


def _uses(uses: Sequence[tuple[str, str]]) -> str:
    return f"uses({', '.join(f'{name}(version={version!r})' for name, version in uses)})".replace("'", '"')


def files(robot: RobotConfig) -> Iterator[str]:
    """The files that `check` may read in the packages around the robot's package; they need not exist."""
    for folder in robot.folder.parents[: robot.target.package.count(".")]:
        yield from (f"{folder}/package.mo", f"{folder}/package.order")


def merge_order(text: str | None, names: Sequence[str], owned: Collection[str] = ()) -> str:
    """Return a `package.order` with `names`, without the rest of `owned`; `text` is None if there is no file.

    `owned` are the names that urdfsync wrote last, in order. All other lines are the user's and keep their places. The
    lines of `names` are in this order, unless the user has moved them. A new line stands next to its neighbour in
    `names`. The line endings of the file stay. The result is empty if no line remains.
    """
    if text is None:
        return "".join(f"{name}\n" for name in names)
    wanted, old_lines = set(names), text.splitlines()
    if old_lines == list(names) and len(wanted) == len(old_lines):
        return text
    lines, kept = [], set()
    for line in old_lines:
        name = _order_name(line)
        if name in wanted and name not in kept:
            kept.add(name)
            lines.append(line)
        elif name not in wanted and name not in owned:
            lines.append(line)
    ordered = [name for name in names if name in kept]
    present = [name for name in map(_order_name, lines) if name in kept]
    if present != ordered and present == [name for name in owned if name in kept]:
        ours = iter(ordered)
        lines = [next(ours) if _order_name(line) in kept else line for line in lines]
    for index, name in enumerate(names):
        if name not in kept:
            places = {_order_name(line): place for place, line in enumerate(lines)}
            last = max((place + 1 for other, place in places.items() if other), default=0)
            first = next((places[other] for other in names if other in places), last)
            lines.insert(places[names[index - 1]] + 1 if index else first, name)
    if lines == old_lines:
        return text
    ending = "\r\n" if "\r\n" in text else "\n"
    return ending.join(lines) + ending if any(map(_order_name, lines)) else ""


def _order_name(line: str) -> str:
    return line.strip("\ufeff \t\r\f\v")
