"""The package of one robot: on disk, generated, and the differences.

A compiler reads all files below a folder, and one unparsable file stops it. So packages of other robots are left out,
unless a text mentions them.
"""

from __future__ import annotations

import codecs
import os
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path

import msgspec

from urdfsync.analysis.checks.contents import package_texts
from urdfsync.common.diagnostics import Diagnostic, Severity, UrdfsyncError
from urdfsync.common.files import normalised, shown
from urdfsync.domain import Role
from urdfsync.engine.actions import Reason
from urdfsync.engine.build import build
from urdfsync.engine.generation import Generation, generate_robot, generated_texts
from urdfsync.engine.inspect.inputs import Inputs, inspect
from urdfsync.engine.inspect.users_files import read_users_files
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.package.generate import Package
from urdfsync.modelica.files import has_word, text_of
from urdfsync.modelica.lexer import lex
from urdfsync.modelica.names import within
from urdfsync.modelica.parser import parse
from urdfsync.modelica.stamp import with_stamp
from urdfsync.modelica.syntax import Class
from urdfsync.project.config import Config, RobotConfig


class PackageTexts(msgspec.Struct, frozen=True):
    """A Modelica package that is stored as a folder. Paths are POSIX paths below this folder."""

    name: str
    """The package's full name, as in `Plant.Robots.Arm`."""
    folder: Path
    """The package's folder for messages, which may not exist yet."""
    texts: Mapping[str, bytes]
    """The package's `.mo` and `package.order` files by path."""
    owners: Mapping[str, str] = msgspec.field(default_factory=dict)
    """The element that a file belongs to, in the domain's words: `joint elbow`."""
    edited: Collection[str] = ()
    """The files whose texts differ from the generated texts."""

    def text(self, path: str) -> str:
        """Return the text of a file; bytes that are not UTF-8 are replaced."""
        return self.texts[path].decode("utf-8", "replace")

    def diagnostic(
        self, severity: Severity, code: str, message: str, path: str, line: int = 0, column: int = 0, hint: str = ""
    ) -> Diagnostic:
        """Return a finding in one of the files, or in a folder; the finding names the element."""
        owner = self.owners.get(path, "")
        message = f"{owner}: {message}" if owner else message
        return Diagnostic(severity, code, message, shown(self.folder / path), line, column, hint)

    def by_hand(self, path: str) -> str:
        """Return a hint for a file that was edited; empty for other files."""
        return "the file was edited by hand" if path in self.edited else ""


class RobotPackage(msgspec.Struct):
    """The package of one robot as it is now."""

    robot: RobotConfig
    inputs: Inputs
    generation: Generation
    errors: tuple[Diagnostic, ...]
    """Errors that a build would report, except those in Modelica files."""
    on_disk: Mapping[str, bytes]
    """The bare Modelica files of the package on disk, by their path below the package; none without a package."""
    in_step: bool
    conflicting: bool
    """Whether the package is out of step because of a conflict."""
    generated: Mapping[str, bytes]
    """The generated files of the package, by their path below the package."""
    own_files: Mapping[Path, bytes]
    """The user's own Modelica files in the package."""
    files: PackageTexts
    """The checked texts: those of the package on disk, or of the generated package if none is on disk."""
    around: Mapping[str, bytes]
    """See `files_around`."""
    users_files: Mapping[Path, bytes]
    """See `users_files`."""
    models: tuple[str, ...]
    """The classes that have to compile by themselves, by their names below the package, the main one first."""
    changed: tuple[str, ...]
    """The edited files, without those that differ in comments and blanks only."""
    edits: tuple[str, ...]
    """The files in `changed` that belong to the main model."""
    hints: Mapping[tuple[str, str], str]
    """The hints of a build about unresolved names, which know of renames, by file and message."""


def read_package(config: Config, robot: RobotConfig, options: BuildOptions) -> RobotPackage:
    """Read and generate the package of a robot, without writing.

    Raises UrdfsyncError for faults of source, state or templates, OSError for unreadable files.
    """
    (built,) = build(config, [robot], options)
    if built.failed:
        raise UrdfsyncError(*built.diagnostics)
    inputs = inspect(config, robot, options)
    generation = generate_robot(inputs)
    snapshot = generation.now.snapshot
    errors = [finding for finding in built.diagnostics if finding.severity is Severity.ERROR]
    on_disk = {path: with_stamp(text, None) for path, text in package_texts(robot.folder).items()}
    generated = generated_texts(inputs, generation)
    texts, in_step = on_disk or generated, bool(on_disk) and built.are_files_in_step
    checks = inputs.domain.checks
    models = (
        checks.models(snapshot, robot.target, robot.options) if checks else _generated_models(generation.package, robot)
    )
    benches = {f"{name.replace('.', '/')}.mo" for name in models[1:]}
    shared = [path for path in sorted(generated.keys() & on_disk.keys()) if path.endswith(".mo")]
    edited = [path for path in shared if normalised(on_disk[path]) != generated[path]] if in_step else []
    changed = tuple(path for path in edited if _words(generated[path]) != _words(on_disk[path]))
    # if the build that renames an element waits for a conflict, its files still have the old names
    known = [action for action in built.actions if action.reason is not Reason.UNKNOWN]
    keys = (key for action in known for key in (action.path, action.origin) if key)
    written = {Path(os.path.normpath(config.root / key)) for key in keys}
    written.update(robot.folder / path for path in generated)
    own_files = {robot.folder / path: text for path, text in on_disk.items() if path.endswith(".mo")}
    owners = {path: artifact.owner for path, artifact in generation.package.artifacts.items()}
    return RobotPackage(
        robot=robot,
        inputs=inputs,
        generation=generation,
        errors=tuple(dict.fromkeys(error for error in errors if not error.file.endswith(".mo"))),
        on_disk=on_disk,
        in_step=in_step,
        conflicting=bool(built.conflicts),
        generated=generated,
        own_files={path: text for path, text in own_files.items() if path not in written},
        files=PackageTexts(robot.target.package, robot.folder, texts, owners, edited),
        around=files_around(config, robot, texts),
        users_files=users_files(config, robot),
        models=tuple(models),
        changed=changed,
        edits=tuple(path for path in changed if path not in benches),
        hints={(one.file, one.message): one.hint for one in built.diagnostics if one.code == "unresolved"},
    )


def _generated_models(package: Package, robot: RobotConfig) -> Sequence[str]:
    """Return the model of the package's name; if there is none, all generated models."""
    artifacts, name = package.artifacts, robot.target.name
    if f"{name}.mo" in artifacts:
        return (name,)
    paths = (path for path, artifact in artifacts.items() if artifact.role is Role.MODEL)
    return [path.removesuffix(".mo").replace("/", ".") for path in paths]


def _words(text: bytes) -> list[str]:
    """Return the words of a text, without comments and blanks."""
    return [token.text for token in lex(text.decode(errors="replace"))[0]]


def files_around(config: Config, robot: RobotConfig, texts: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the files of the top-level package around a robot's package, by their paths below the output folder.

    Packages of other robots are included if `texts`, those of the robot, or other files around mention them. If a
    package around the robot's is missing, the result has an empty package in its place. Raises OutputError for a file
    that can't be read.
    """
    output, parts = robot.output, robot.target.package.split(".")
    top = output / parts[0]
    others = {other.folder: other.target.package.rpartition(".")[2].encode() for other in config.robots}
    others = {folder: name for folder, name in others.items() if top in folder.parents and folder != robot.folder}
    around = package_texts(top, output, {robot.folder, *others}) if top != robot.folder else {}
    waiting = [*texts.values(), *around.values()] if others else []
    while waiting:
        text = waiting.pop()
        for folder in [folder for folder, name in others.items() if has_word(text, name)]:
            del others[folder]
            mentioned = package_texts(folder, output, others)
            around |= mentioned
            waiting += mentioned.values()
    for count in range(1, len(parts)):
        name = parts[count - 1]
        made_up = f"{within('.'.join(parts[:count]))}\npackage {name}\nend {name};\n"
        around.setdefault(f"{'/'.join(parts[:count])}/package.mo", made_up.encode())
    return around


def users_files(config: Config, robot: RobotConfig) -> Mapping[Path, bytes]:
    """Return the user's models outside of robots' packages that may use this robot's package."""
    return read_users_files(config, robot, [robot.folder.name]).mentioning


class UsersModels(msgspec.Struct, frozen=True):
    """The user's models that can be compiled, in the package and outside of it."""

    files: Mapping[str, Path]
    """The file of each model or block that is not partial, by the model's full name."""
    libraries: Mapping[str, Path]
    """Folder or file of each top-level class that holds such models, except the class around the package."""
    left_out: tuple[Path, ...]
    """Files that no compiler would find, or that are no Modelica."""
    uses: Mapping[Path, Collection[Path]]
    """For each file that the user wrote or edited, the files that it uses."""


def users_models(
    robot: RobotConfig, files: Mapping[Path, bytes], uses: Mapping[Path, Collection[Path]] | None = None
) -> UsersModels:
    """Return the models in the user's files that can be compiled."""
    models, libraries, left_out = dict[str, Path](), dict[str, Path](), list[Path]()
    top = robot.target.package.partition(".")[0]
    for path, content in files.items():
        text = parse(text_of(content))
        around = tuple(text.within.split(".")) if text.within else ()
        place = path.parent if path.name == "package.mo" else path
        name = (*around, text.classes[0].name.parts[0]) if len(text.classes) == 1 else ()
        root = place.parents[len(around) - 1] if 0 < len(around) <= len(place.parents) else place
        is_stored = place.with_suffix("").parts[-len(name) :] == name and (
            not around or (root / "package.mo").is_file()
        )
        is_around = bool(name) and name[0] == top and root == robot.output / top
        if text.is_broken or not name or not is_stored or (name[0] == top and not is_around):
            left_out.append(path)
            continue
        if not is_around:
            libraries[name[0]] = root
        models |= dict.fromkeys(_models_in(text.classes, around), path)
    return UsersModels(models, libraries, tuple(left_out), uses or {})


def _models_in(classes: Sequence[Class], around: tuple[str, ...]) -> Iterator[str]:
    """Yield the models and blocks in classes that are not partial, by their full names."""
    for definition in classes:
        name = (*around, definition.name.parts[0])
        if definition.kind in ("model", "block") and "partial" not in definition.prefixes:
            yield ".".join(name)
        elif definition.kind == "package":
            yield from _models_in(definition.classes, name)


def write_package(folder: Path, robot: RobotConfig, texts: Mapping[str, bytes], around: Mapping[str, bytes]) -> Path:
    """Write the package in `texts`, with the files around it, below `folder`. Returns the top-level package."""
    place = robot.target.package.replace(".", "/")
    for name, content in {**around, **{f"{place}/{path}": content for path, content in texts.items()}}.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.removeprefix(codecs.BOM_UTF8))  # rumoca refuses a byte order mark
    return folder / robot.target.package.partition(".")[0]
