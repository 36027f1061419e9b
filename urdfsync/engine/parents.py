"""The packages around a generated one: they must exist, or be made if the configuration says so; their order files.

A `package.order` has to name every class of its package, and classes inside of a `package.mo` can't be told without a
Modelica parser. So urdfsync enters its names into files that exist, and makes such a file only with the package.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.config import Config, RobotConfig, shown
from urdfsync.dependencies import is_file, is_folder, read_file
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.engine.package_files import PackageFiles, encode
from urdfsync.files import digest
from urdfsync.modelica.names import LIBRARY, within
from urdfsync.state.transaction import Change


class Parents(msgspec.Struct, frozen=True):
    """What of the packages above a robot's has to be written."""

    created: Mapping[Path, bytes]
    """`package.mo` of every parent that does not exist yet."""
    entered: Mapping[Path, str]
    """`package.order` files above the parent's, and the created package that each has to name."""
    listed: bool = True
    """Whether the parent's `package.order` has to name the robot's package: if it is there, or made with the parent."""
    diagnostics: tuple[Diagnostic, ...] = ()


class SharedFile(msgspec.Struct, frozen=True):
    """A file around the package, in which other robots may have a part: a `package.mo` or a `package.order`.

    It is read again when it is written, so that robots with one parent package can be planned at the same time.
    """

    path: Path
    content: bytes | None = None
    """Content of a `package.mo` that is written if there is none."""
    names: tuple[str, ...] = ()
    """Lines that a `package.order` has to have."""
    owned: tuple[str, ...] = ()
    """Lines of a `package.order` that urdfsync may remove."""

    def change(self, files: PackageFiles) -> Change | None:
        """Return what is left to do, from what is on disk now; None if nothing is."""
        found = files.read_path(self.path)
        if self.content is not None:
            return Change(self.path, self.content, None) if found is None else None
        old = None if found is None else found.decode(errors="surrogateescape")
        new = merge_order(old, self.names, self.owned)
        if new == (old or ""):
            return None
        return Change(self.path, encode(new) if new else None, None if found is None else digest(found))


def check(config: Config, robot: RobotConfig, uses: Sequence[tuple[str, str]]) -> Parents:
    """Look at the output folder and at all parents of the robot's package, which needs the libraries `uses`.

    Raises OutputError, at the line of the configuration that says so, if the package can't be there.
    """
    file = shown(config.file)
    _check_output(config, robot, file)
    parts = robot.target.package.split(".")
    _check_library(robot, parts, file)
    created: dict[Path, bytes] = {}
    entered: dict[Path, str] = {}
    for depth in range(1, len(parts) + 1):
        folder, name = robot.output.joinpath(*parts[:depth]), ".".join(parts[:depth])
        single = folder.with_name(f"{folder.name}.mo")
        if is_file(single):
            message = f"package `{name}` is the single file {shown(single)}; it has to be a folder with a package.mo"
            raise OutputError(_problem("package-is-file", message, "package", robot, file, "convert it, or move it"))
        if depth == len(parts) or is_file(folder / "package.mo"):
            continue
        if not robot.create_parents:
            message = f"the parent package `{name}` does not exist in {shown(robot.output)}"
            hint = "create it, or set `create_parents = true`"
            raise OutputError(_problem("no-parent", message, "package", robot, file, hint))
        created[folder / "package.mo"] = _package(name, uses)
        if depth > 1 and _is_ordered(folder.parent, created):
            entered[folder.parent / "package.order"] = parts[depth - 1]
    return Parents(created, entered, _is_ordered(robot.folder.parent, created), tuple(_check_uses(robot, parts, uses)))


def files(robot: RobotConfig) -> Iterator[str]:
    """The files of the packages around a robot's that `check` may look at, there or not."""
    for folder in robot.folder.parents[: robot.target.package.count(".")]:
        yield from (f"{folder}/package.mo", f"{folder}/package.order")


def _is_ordered(package: Path, created: Mapping[Path, bytes]) -> bool:
    """Whether a package has a `package.order`, or gets one because urdfsync makes the package."""
    return package / "package.mo" in created or is_file(package / "package.order")


def _check_library(robot: RobotConfig, parts: Sequence[str], file: str) -> None:
    """Only the library's own output folder may hold a package of its name: it would hide the library from tools."""
    if parts[0] == LIBRARY and not is_file(robot.output / LIBRARY / "package.mo"):
        message = f"`{LIBRARY}` is the library that models need; a package of that name would hide it"
        hint = f"choose another top-level package than `{LIBRARY}`"
        raise OutputError(_problem("modelica-name", message, "package", robot, file, hint))


def _check_output(config: Config, robot: RobotConfig, file: str) -> None:
    output = robot.output
    if is_folder(output):
        if is_file(output / "package.mo"):
            message = f"the output folder {shown(output)} is a Modelica package itself"
            hint = "name the folder above it as output, and the package with its full name"
            raise OutputError(_problem("output-is-package", message, "output", robot, file, hint))
        return
    existing = next(folder for folder in (output, *output.parents) if folder.exists() or folder.is_symlink())
    if not existing.is_dir():
        message = f"the output folder {shown(output)} can't be made: {shown(existing)} is no folder"
        raise OutputError(_problem("output-is-file", message, "output", robot, file, "name another folder"))
    if config.root not in output.parents:
        message = f"the output folder {shown(output)} does not exist"
        hint = "create it: urdfsync makes folders only beside or below its configuration"
        raise OutputError(_problem("no-output", message, "output", robot, file, hint))


def _check_uses(robot: RobotConfig, parts: Sequence[str], uses: Sequence[tuple[str, str]]) -> Iterator[Diagnostic]:
    """A warning if the user's top-level package does not say which libraries it needs now."""
    top = robot.output / parts[0] / "package.mo"
    if len(parts) == 1 or not is_file(top):
        return
    text = read_file(top).decode(errors="replace")
    missing = [use for use in uses if use[0] != parts[0] and not re.search(rf"\b{use[0]}\s*\(\s*version", text)]
    if missing:
        message = f"package `{parts[0]}` does not say that it needs {' and '.join(name for name, _ in missing)}"
        hint = f"add `{_uses(missing)}` to its annotation"
        yield Diagnostic(Severity.WARNING, "no-uses", message, shown(top), hint=hint)


def _package(name: str, uses: Sequence[tuple[str, str]]) -> bytes:
    parent, _, last = name.rpartition(".")
    annotation = "" if parent else f"  annotation ({_uses(uses)});\n"
    return f'{within(name)}\npackage {last} "{last}"\n{annotation}end {last};\n'.encode()


def _uses(uses: Sequence[tuple[str, str]]) -> str:
    return f"uses({', '.join(f'{name}(version={version!r})' for name, version in uses)})".replace("'", '"')


def _problem(code: str, message: str, key: str, robot: RobotConfig, file: str, hint: str) -> Diagnostic:
    line = robot.lines.get(key, robot.lines[""])
    return Diagnostic(Severity.ERROR, code, f"robot `{robot.name}`: {message}", file, line, hint=hint)


def merge_order(text: str | None, names: Sequence[str], owned: Collection[str] = ()) -> str:
    """Return a `package.order` with `names` in it, and without the other names of `owned`; None stands for no file.

    `owned` are the names that urdfsync wrote last, in their order; all other lines are the user's and keep their
    places. Our lines follow the order of `names`, unless the user has moved them; a new one goes next to its
    neighbour in `names`. Line endings are those of the file. The result is empty if no line is left.
    """
    if text is None:
        return "".join(f"{name}\n" for name in names)
    wanted, found = set(names), text.splitlines()
    if found == list(names) and len(wanted) == len(found):
        return text
    lines, kept = [], set()
    for line in found:
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
        if name in kept:
            continue
        places = {_order_name(line): place for place, line in enumerate(lines)}
        before = next((places[other] + 1 for other in reversed(names[:index]) if other in places), None)
        after = next((places[other] for other in names[index + 1 :] if other in places), None)
        last = max((place + 1 for other, place in places.items() if other), default=0)
        lines.insert(before if before is not None else after if after is not None else last, name)
    if lines == found:
        return text
    ending = "\r\n" if "\r\n" in text else "\n"
    return ending.join(lines) + ending if any(map(_order_name, lines)) else ""


def _order_name(line: str) -> str:
    return line.strip("\ufeff \t\r\f\v")
