"""Reads a robot's source, as bytes and as a model, and its templates."""

from __future__ import annotations

import contextlib
import functools
import stat
from bisect import bisect_right
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path, PurePath
from typing import TYPE_CHECKING, Any

import msgspec

from urdfsync.common import system
from urdfsync.common.dependencies.facts import PATH, look, read_unrecorded
from urdfsync.common.dependencies.places import label, real
from urdfsync.common.dependencies.reads import (
    cannot_record,
    depend_on,
    file_type,
    is_file,
    is_folder,
    list_folder,
    read_file,
)
from urdfsync.common.diagnostics import ConfigError, Detail, Diagnostic, Severity, SourceError, UrdfsyncError
from urdfsync.common.files import Templates, digest, kind_of, shown, templates_digest
from urdfsync.domain import Companion, CompanionKind, Domain, Reading, Snapshot, Translator, registry
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.sources.translators import XACRO, find_translator
from urdfsync.project.config import Config, RobotConfig, templates_folder
from urdfsync.project.config.trust import find_untrusted_command
from urdfsync.project.state.expansion import Expansion, dumps
from urdfsync.project.state.store import Store

if TYPE_CHECKING:
    from urdfsync.engine.sources.expansion import SourceFiles

MAX_TEMPLATE = 10_000_000
"""The greatest number of bytes of a file in the user's template folder; the longest template of urdfsync has 5,000."""

NEVER: tuple[str, ...] = ("no expansion is recorded",)
"""The only entry of `Source.stale` if no expansion is recorded."""


class Source(msgspec.Struct, frozen=True):
    """The text of a source, the files that it is read with, and its inputs."""

    content: bytes
    name: str
    """The source's name in diagnostics."""
    places: Sequence[tuple[int, str, int]] = ()
    """Line of each element in an expanded text, with the element's original file and line."""
    diagnostics: tuple[Diagnostic, ...] = ()
    expansion: Expansion | None = None
    stale: tuple[str, ...] = ()
    """Changed inputs of the source, if this build could not expand it again."""
    is_made_here: bool = False
    """Whether this machine has expanded the source, now or before."""
    companions: tuple[Companion, ...] = ()

    @property
    def format(self) -> str:
        """The suffix of a source that was expanded; empty for a plain one."""
        return PurePath(self.name).suffix if self.expansion else ""

    @property
    def is_missing(self) -> bool:
        """Whether a `command` was never run, so that there is no source yet (only in dry runs)."""
        return bool(self.stale) and not self.content

    def locate(self, found: Diagnostic) -> Diagnostic:
        """Return a diagnostic about the text, with the files and lines that the user wrote."""
        if not self.places or found.file != self.name or not found.line:
            return found
        file, line = self.place(found.line)
        places = [self.place(detail.line) for detail in found.details]
        details = tuple(Detail(n, one.text, name) for one, (name, n) in zip(found.details, places, strict=True))
        if any(detail.text for detail in details):
            details = tuple(dict.fromkeys(details))  # calls of one macro repeat details
        return msgspec.structs.replace(found, file=file, line=line, column=0, details=details)

    def place(self, line: int) -> tuple[str, int]:
        """Return the original place of the element at a line of the text; above the root element, the root's place."""
        if not self.places:
            return self.name, line
        number = bisect_right(self.places, line, key=lambda place: place[0])
        return self.places[max(number - 1, 0)][1:]

    @contextlib.contextmanager
    def locating(self) -> Iterator[None]:
        """Give errors of the `with` block the files and lines that the user wrote."""
        try:
            yield
        except UrdfsyncError as error:
            raise type(error)(*map(self.locate, error.diagnostics)) from None


def read_source(config: Config, robot: RobotConfig, store: Store, options: BuildOptions, name: str = "") -> Source:
    """Read the robot's source with its companions; xacro or a command may make the source first.

    `name` is the robot's name in the state, if it differs. The source is expanded again, unless this machine has noted
    the text and its inputs. If the translator or a file is missing, the recorded text is used. A dry run runs no
    command. Raises SourceError for an unreadable source, at the line of the configuration, and ConfigError for an
    untrusted command. Raises SourceError for a companion beside the source that no option names: a rename would
    silently remove it.
    """
    text, is_former = _read_source(config, robot, store, options, name), bool(label(str(robot.source)))
    is_plain = not (robot.command or text.expansion)
    beside = read_beside(registry.domain(robot.domain), robot.source, robot.options) if is_plain else ()
    for unnamed in beside if not is_former else ():  # a revision may be older than the project
        message = f"robot `{robot.name}`: {unnamed.file} stands beside the source, and no option names it"
        hint = f"set `{unnamed.option}` to its path, or move the file away"
        raise SourceError.of("unnamed-file", message, shown(config.file), robot.lines[""], hint=hint)
    return with_named_companions(config, robot, msgspec.structs.replace(text, companions=beside))


def _read_source(config: Config, robot: RobotConfig, store: Store, options: BuildOptions, name: str) -> Source:
    translator = None
    if not robot.command:
        content = _read(config, robot)  # reports a file that xacro can't read
        has_arguments = robot.arguments is not None
        translator = find_translator(robot.domain, robot.source, content, has_arguments=has_arguments)
        if translator is None:
            return Source(content, shown(robot.source))
    from urdfsync.engine.sources import expansion  # takes 5 ms, and few robots need it

    inputs = expansion.SourceFiles(config.root, robot.source, (*robot.package_paths, *options.package_paths))
    made = store.load_expansion(name or robot.name)
    is_former = bool(label(str(robot.source)))  # a revision has what a build recorded there
    changed = () if made and is_former else inputs.find_changes(robot, made) if made else NEVER
    is_noted = made is not None and (is_former or expansion_hash(made) == store.notes(name or robot.name).expansion)
    if robot.command:
        is_there = is_file(robot.source)
        changed = changed or (() if is_there else (robot.source.name,))
        if (changed or options.full) and not options.dry:
            made, changed, is_noted = _expand(config, robot, inputs, options, translator), (), True
        content = _read(config, robot) if is_there or not options.dry else b""
        reason = "" if is_noted else "its command did not run on this machine"
    else:
        reason = ""
        if made is None or changed or options.full or not is_noted:
            try:
                made, changed = _expand(config, robot, inputs, options, translator), ()
            except SourceError as error:
                if made is None or changed or not (reason := inputs.why_not_expandable(made, error)):
                    raise
        content = made.text.encode() if made else b""
    if made is None:
        return Source(content, shown(robot.source), stale=changed)
    place = shown(config.file), robot.lines.get("arguments", 0)
    told = list(_warnings(made, robot.source, place, f"robot `{robot.name}`: "))
    if reason and not changed:
        message = f"the recorded source is used, unchecked: {reason}"
        told.append(Diagnostic(Severity.NOTE, "as-recorded", message, shown(robot.source)))
    return Source(content, shown(robot.source), inputs.places(made), tuple(told), made, changed, not reason)


def expansion_hash(made: Expansion) -> str:
    """Return the hash by which this machine notes an expansion."""
    return digest(dumps(made))


def _expand(
    config: Config, robot: RobotConfig, inputs: SourceFiles, options: BuildOptions, translator: Translator | None
) -> Expansion:
    """Make a source by translator or command. Raises SourceError, and ConfigError for a command without trust."""
    from urdfsync.engine.sources import expansion

    if translator is not None:
        made = expansion.expand(inputs, robot.arguments or {}, translator=translator)
        made = msgspec.structs.replace(made, source=robot.source_text)
    elif options.trusted or (untrusted := find_untrusted_command(config, robot)) is None:
        made = inputs.look(robot, Expansion())
        expansion.run_command(config, robot)
    else:
        raise ConfigError(untrusted)
    if inputs.find_changes(robot, made):
        cannot_record()  # somebody saved a file meanwhile
    return made


def read_beside(domain: Domain, source: Path, options: Any = None) -> tuple[Companion, ...]:
    """Return the companions beside the file `source`.

    A kind of companion that `options` name is left out: see `with_named_companions`.
    """
    found = list[Companion]()
    for kind, path in companions_beside(domain, source, options):
        content = read_file(path) if is_file(path) else None
        if content is not None and kind.mark.search(content.replace(b"\0", b"")):  # UTF-16 has a zero in a letter
            found.append(Companion(kind.option, shown(path), content))
    return tuple(found)


def companions_beside(domain: Domain, source: Path, options: Any = None) -> Iterator[tuple[CompanionKind, Path]]:
    """Yield the paths of companions beside a source, existing or not, except those of kinds that `options` name."""
    for kind in domain.companions:
        if kind.suffix and not getattr(options, kind.option, ""):
            yield kind, source.with_suffix(kind.suffix)


def with_named_companions(config: Config | None, robot: RobotConfig, text: Source) -> Source:
    """Return a source with the companions that its robot's options name. Raises SourceError for a missing file."""
    found = list(text.companions)
    for kind in registry.domain(robot.domain).companions:
        named = getattr(robot.options, kind.option)
        if config and named and (not kind.needed_by or getattr(robot.options, kind.needed_by)):
            found.append(_read_named(config, robot, kind.option, config.root / named))
    return msgspec.structs.replace(text, companions=tuple(found))


def _read_named(config: Config, robot: RobotConfig, option: str, path: Path) -> Companion:
    """Return the companion at a path that an option names. Raises SourceError at the line of the option."""
    try:
        content = read_file(path)
    except OSError as error:
        reason = "it does not exist" if isinstance(error, FileNotFoundError) else error.strerror
        message = f"robot `{robot.name}`: `{option}` names {shown(path)}, which can't be read: {reason}"
        hint = "name a revision that has the file" if label(str(path)) else f"put the file there, or correct `{option}`"
        raise SourceError.of("no-source", message, shown(config.file), robot.lines[option], hint=hint) from None
    return Companion(option, shown(path), content)


def read_file_source(
    domain: Domain, file: Path, arguments: Mapping[str, str], package_paths: Sequence[Path], options: Any = None
) -> Source:
    """Read a source that no configuration names, with these arguments if a translator reads it. Raises SourceError.

    A companion that `options` name is left out: see `with_named_companions`.
    """
    try:
        content = read_unrecorded(file)
    except OSError as error:
        message = f"the source can't be read: {error.strerror}"
        hint = system.held_hint(error) or "name an existing, readable file"
        raise SourceError.of("no-source", message, shown(file), hint=hint) from None
    translator = find_translator(domain.name, file, content)
    if translator is None:
        return Source(content, shown(file), companions=read_beside(domain, file, options))
    from urdfsync.engine.sources import expansion

    folder, here = file.absolute().parent, Path.cwd()
    # a project may begin in the working folder; in xacro, this folder is the value of `$(cwd)`
    root = here if translator is not XACRO and folder.is_relative_to(here) else folder
    inputs = expansion.SourceFiles(root, file.absolute(), package_paths)
    made = expansion.expand(inputs, arguments, translator=translator)
    told = _warnings(made, file, (shown(file), 0))
    return Source(made.text.encode(), shown(file), inputs.places(made), told, made)


def _warnings(made: Expansion, file: Path, place: tuple[str, int], robot: str = "") -> tuple[Diagnostic, ...]:
    """Return xacro's warnings about a source, and warnings about unknown arguments, at `place`."""
    findings = []
    for name in made.unused:
        message = f"{robot}the source has no argument `{name}`"
        findings.append(Diagnostic(Severity.WARNING, "unused-argument", message, *place, hint="correct its name"))
    for text in made.warnings:
        kind, _, message = text.partition(": ")
        is_warning = kind in ("warning", "error")
        severity = Severity.WARNING if is_warning else Severity.NOTE
        findings.append(Diagnostic(severity, "xacro-said", message if is_warning else text, shown(file)))
    return tuple(findings)


def _read(config: Config, robot: RobotConfig) -> bytes:
    """Return the bytes of the robot's source. Raises SourceError at the line of the configuration that names it."""
    hint = "`urdfsync build` runs its command" if robot.command else "correct `source`, or export the file again"
    try:
        if (mode := file_type(robot.source)) in (0, stat.S_IFREG):
            return read_file(robot.source)
        reason = f"is {kind_of(mode)}"
    except OSError as error:
        reason = "does not exist" if isinstance(error, FileNotFoundError) else f"can't be read: {error.strerror}"
        hint = system.held_hint(error) or hint
    message = f"robot `{robot.name}`: the source {shown(robot.source)} {reason}"
    line = robot.lines.get("source", 0)
    raise SourceError.of("no-source", message, shown(config.file), line, hint=hint)


def templates(config: Config, robot: RobotConfig, domain: Domain) -> Templates:
    """Return the robot's templates: those in its own folder hide the domain's. Raises ConfigError for a bad folder."""
    if robot.templates is None:
        return domain_templates(domain)
    if not is_folder(robot.templates):
        message = f"robot `{robot.name}`: the template folder {shown(robot.templates)} does not exist"
        line, hint = robot.lines.get("templates", 0), "create it, or take `templates` out"
        raise ConfigError.of("no-templates", message, shown(config.file), line, hint=hint)
    _check_templates(robot.templates)
    return domain_templates(domain, robot.templates)


def domain_templates(domain: Domain, *own: Path) -> Templates:
    """Return the templates of a domain; files in the user's folders hide templates of the same name."""
    folders = (*own, templates_folder(domain))
    return Templates(folders, templates_digest(folders))


def _check_templates(folder: Path) -> None:
    """Refuse links that lead out of a template folder, and too large files: a stranger may have made them.

    Raises ConfigError.
    """
    waiting = [folder]
    for path in waiting:
        kind, target, message = file_type(path, follow=False), file_type(path), ""
        if kind == stat.S_IFDIR or path == folder:
            with contextlib.suppress(OSError):  # an unreadable folder has no templates
                waiting += map(path.joinpath, list_folder(path))
        elif kind == stat.S_IFLNK and not Path(real(path)).is_relative_to(real(folder)):
            message = "the link leads out of the template folder"
            hint = "replace it by a copy of its target"
        elif target == stat.S_IFREG and look(PATH, path)[-3] > MAX_TEMPLATE:
            depend_on(path)
            message = f"the file has more than {MAX_TEMPLATE:,} bytes, which is too large for a template"
            hint = "move it out of the template folder"
        elif target not in (0, stat.S_IFREG, stat.S_IFDIR):  # reading a FIFO might never end
            message = f"this is {kind_of(target)}, not a template"
            hint = "move it out of the template folder"
        if message:
            raise ConfigError.of("template", message, shown(path), hint=hint)


def check_options(config: Config, robot: RobotConfig, reading: Reading) -> tuple[Diagnostic, ...]:
    """Return the findings about the robot's options for this model, at the lines of the options.

    Raises ConfigError with all options that do not suit the model.
    """
    findings = tuple(
        msgspec.structs.replace(
            said,
            message=f"robot `{robot.name}`: {said.message}",
            file=shown(config.file),
            line=robot.lines.get(option, robot.lines[""]),
        )
        for option, said in reading.option_findings
    )
    if errors := [said for said in findings if said.severity is Severity.ERROR]:
        raise ConfigError(*sorted(errors, key=lambda error: error.line))
    return findings


def read(domain: Domain, options: Any, text: Source, cured: Collection[str] = ()) -> tuple[Snapshot, Reading]:
    """Return the model in a source, and its reading; errors with a code of `cured` become warnings.

    Raises SourceError with all faults.
    """
    reading = _read_model(domain, msgspec.json.encode(options), text.content, text.name, text.companions)  # type: ignore[arg-type] # the domain is an object
    findings = tuple(
        msgspec.structs.replace(one, severity=Severity.WARNING) if one.code in cured else one
        for one in reading.diagnostics
    )
    if reading.snapshot is None or any(finding.severity is Severity.ERROR for finding in findings):
        raise SourceError(*findings)
    return reading.snapshot, msgspec.structs.replace(reading, diagnostics=findings)


def read_permissively(domain: Domain, text: Source) -> tuple[Snapshot, Reading]:
    """Read a source outside of a project, as `read` does, with the domain's permissive options."""
    with text.locating():
        return read(domain, domain.permissive_options or domain.options(), text, domain.cured)


@functools.lru_cache(maxsize=4)
def _read_model(
    domain: Domain, options: bytes, content: bytes, name: str, companions: tuple[Companion, ...]
) -> Reading:
    """Read a source. The last result is kept: the daemon confirms each build by a second build.

    Serves the rows "one mass changed in the daemon" of docs/speed.md. Options are JSON, since they may not be hashable.
    """
    return domain.read(content, name, msgspec.json.decode(options, type=domain.options), *companions)
