"""A first `urdfsync.toml`: guessed from the sources, commented, and with the reason of every guess."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import msgspec
import tomli_w

from urdfsync import registry
from urdfsync.config import values
from urdfsync.config.names import is_robot_name
from urdfsync.config.paths import shown
from urdfsync.dependencies import read_unrecorded
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity, SourceError
from urdfsync.domain import Domain, Proposal
from urdfsync.files import put
from urdfsync.modelica.names import class_name

_HEADER = """\
# Robots that urdfsync keeps in step with their Modelica packages.
# Paths count from this file's folder. `urdfsync build` builds all of them.
"""
_DEFAULTS = """\
# Settings for all robots; a robot's own table wins.
[defaults]
output = "modelica"  # the folder that the packages go into
# create_parents = true  # make the packages around `package` if they do not exist
# on_build = "check"  # compile each package after its build, as `urdfsync check` does; default "nothing"
# on_conflict = "merge"  # where you and the source changed a file, merge if that leaves no doubt; default "keep"
# package_paths = []  # folders that hold packages, where sources refer to files in them
# templates = "templates"  # a folder with templates that replace single ones of urdfsync
"""

_LONGEST = 80
"""A longer stem is cut: robots and packages become names of files."""


class Guess(msgspec.Struct, frozen=True):
    """What is proposed for one robot."""

    robot: str
    source: str
    package: str
    options: tuple[Proposal, ...]


class Draft(msgspec.Struct, frozen=True):
    """A configuration that is not written yet."""

    file: Path
    text: str
    guesses: tuple[Guess, ...]
    diagnostics: tuple[Diagnostic, ...]
    """Warnings about the sources."""


def make_draft(file: Path, sources: Sequence[Path], domain_name: str) -> Draft:
    """The configuration `file` for these sources, or for those that are below its folder if none is given.

    A source that is named twice counts once. Raises ConfigError if the file exists or if there is no source,
    SourceError if one that is named can't be read, or none of those that were found.
    """
    if file.exists():
        raise _exists(file)
    domain = registry.domain(domain_name)
    found = [] if sources else list(_search(file.parent, f".{domain.name}"))
    if not sources and not found:
        message, hint = f"no *.{domain.name} below {shown(file.parent)}", "name the sources: `urdfsync init SOURCE`"
        raise ConfigError(Diagnostic(Severity.ERROR, "no-source", message, hint=hint))
    guesses: list[Guess] = []
    said: list[Diagnostic] = []
    broken: list[Diagnostic] = []
    for source in _once(sources or found):
        try:
            options, diagnostics = _propose(domain, source, file.parent)
        except SourceError as error:
            if sources:
                raise
            broken += error.diagnostics
            said.append(_passed_over(source, error))
            continue
        said += diagnostics
        guesses.append(_guess(file.parent, source, options, guesses))
    if not guesses:
        raise SourceError(*broken)
    return Draft(file, _text(guesses, domain), tuple(guesses), tuple(said))


def write(draft: Draft) -> None:
    """Write a draft, as a whole or not at all. Raises ConfigError if that fails, or if the file exists by now."""
    file = draft.file
    if file.exists():
        raise _exists(file)
    try:
        put(file, draft.text.encode())
    except OSError as error:
        message = f"the configuration can't be written: {error.strerror}"
        hint = "check the folder's permissions and the space on the disk, or name another file with --config"
        raise ConfigError(Diagnostic(Severity.ERROR, "config-not-written", message, shown(file), hint=hint)) from None


def _exists(file: Path) -> ConfigError:
    hint = "add a table `[robots.NAME]` to it, or name another file with --config"
    return ConfigError(Diagnostic(Severity.ERROR, "config-exists", "the file exists already", shown(file), hint=hint))


def _search(folder: Path, suffix: str) -> Iterator[Path]:
    """Files with this suffix below `folder`, hidden files and folders left out, sorted."""
    for parent, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        found = [name for name in sorted(files) if name.lower().endswith(suffix) and not name.startswith(".")]
        yield from (Path(parent, name) for name in found)


def _once(sources: Sequence[Path]) -> list[Path]:
    """The sources without those that are the same file as one before."""
    unique: dict[str, Path] = {}
    for source in sources:
        unique.setdefault(os.path.realpath(source), source)
    return list(unique.values())


def _passed_over(source: Path, error: SourceError) -> Diagnostic:
    first = next(found for found in error.diagnostics if found.severity is Severity.ERROR)
    message, hint = f"{first.message}; passed over", f"put it right and add it, or run `urdfsync init {shown(source)}`"
    return msgspec.structs.replace(first, severity=Severity.WARNING, message=message, hint=hint)


def _propose(domain: Domain, source: Path, root: Path) -> tuple[tuple[Proposal, ...], list[Diagnostic]]:
    if any(ord(char) < 32 or ord(char) == 127 or "\ud800" <= char <= "\udfff" for char in _written(source, root)):
        message, hint = "the name of the source can't be written into a configuration", "rename it"
        raise SourceError(Diagnostic(Severity.ERROR, "source-name", message, shown(source), hint=hint))
    try:
        content = read_unrecorded(source)
    except OSError as error:
        message, hint = f"the source can't be read: {error.strerror}", "name a file that is there and may be read"
        raise SourceError(Diagnostic(Severity.ERROR, "no-source", message, shown(source), hint=hint)) from None
    reading = domain.read(content, shown(source), domain.options())
    errors = [found for found in reading.diagnostics if found.severity is Severity.ERROR]
    if errors or reading.snapshot is None:
        raise SourceError(*reading.diagnostics)
    return tuple(domain.propose(reading.snapshot)), list(reading.diagnostics)


def _guess(root: Path, source: Path, options: tuple[Proposal, ...], taken: Sequence[Guess]) -> Guess:
    stem = source.name.partition(".")[0][:_LONGEST]
    count = "" if _is_free(stem, "", taken) else next(str(n) for n in range(2, 10_000) if _is_free(stem, str(n), taken))
    return Guess(_robot_name(stem) + count, _written(source, root), class_name(stem) + count, options)


def _written(source: Path, root: Path) -> str:
    """A source's path as the configuration names it."""
    path = source if source.is_absolute() and root not in source.parents else Path(os.path.relpath(source, root))
    return path.as_posix()


def _is_free(stem: str, count: str, taken: Sequence[Guess]) -> bool:
    robot, package = _robot_name(stem) + count, (class_name(stem) + count).casefold()
    return not any(guess.robot == robot or guess.package.casefold() == package for guess in taken)


def _robot_name(stem: str) -> str:
    name = re.sub(r"[^a-z0-9]+", "_", stem.lower()).strip("_")
    return name if is_robot_name(name) else f"robot_{name}".rstrip("_")


def _text(guesses: Sequence[Guess], domain: Domain) -> str:
    parts = [_HEADER, _DEFAULTS]
    parts += [_table(guess, domain) for guess in guesses]
    return "\n".join(parts)


def _table(guess: Guess, domain: Domain) -> str:
    lines = [
        f"[robots.{guess.robot}]",
        _line("source", guess.source),
        _line("package", guess.package) + "  # full name, for example Plant.Robots.Arm; its last part names the class",
    ]
    if domain.name != "urdf":
        lines.append(_line("domain", domain.name))
    proposed = {proposal.option: proposal for proposal in guess.options}
    for field in msgspec.structs.fields(domain.options):
        proposal = proposed.get(field.encode_name)
        if proposal:
            reason = " ".join("".join(char if char.isprintable() else " " for char in proposal.reason).split())
            lines.append(f"{_line(proposal.option, proposal.value)}  # {_choices(field.type)}guessed: {reason}")
        elif field.default not in (msgspec.NODEFAULT, None):  # TOML has no null
            lines.append(f"# {_line(field.encode_name, field.default)}{_comment(field.type)}")
    return "\n".join(lines) + "\n"


def _line(key: str, value: Any) -> str:
    plain_value = msgspec.to_builtins(value)
    if isinstance(plain_value, list | tuple):  # tomli_w gives each item a line, which can't be one comment
        items = (_line("item", item).removeprefix("item = ") for item in plain_value)
        return f"{key} = [{', '.join(items)}]"
    return tomli_w.dumps({key: plain_value}).strip()


def _choices(kind: Any) -> str:
    allowed = values.choices(kind)
    words = " or ".join(f'"{choice}"' for choice in allowed)
    more = ", or several" if values.is_list(kind) else ", or a list of names" if values.may_be_list(kind) else ""
    return f"{words}{more}; " if allowed else ""


def _comment(kind: Any) -> str:
    choices = _choices(kind).removesuffix("; ")
    return f"  # {choices}" if choices else ""
