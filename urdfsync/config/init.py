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
from urdfsync.config.names import is_robot_name
from urdfsync.config.paths import read_source, shown
from urdfsync.config.values import in_words
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
    _refuse_existing(file)
    domain = registry.domain(domain_name)
    found = list(sources or _search(file.parent, f".{domain.name}"))
    if not found:
        message, hint = f"no *.{domain.name} below {shown(file.parent)}", "name the sources: `urdfsync init SOURCE`"
        raise ConfigError(Diagnostic(Severity.ERROR, "no-source", message, hint=hint))
    guesses: list[Guess] = []
    said: list[Diagnostic] = []
    broken: list[Diagnostic] = []
    unique: dict[str, Path] = {}
    for source in found:
        unique.setdefault(os.path.realpath(source), source)
    for source in unique.values():
        try:
            guess, diagnostics = _guess(domain, source, file.parent, guesses)
        except SourceError as error:
            if sources:
                raise
            broken += error.diagnostics
            first = next(found for found in error.diagnostics if found.severity is Severity.ERROR)
            hint = f"put it right and add it, or run `urdfsync init {shown(source)}`"
            message = f"{first.message}; passed over"
            said.append(msgspec.structs.replace(first, severity=Severity.WARNING, message=message, hint=hint))
        else:
            guesses.append(guess)
            said += diagnostics
    if not guesses:
        raise SourceError(*broken)
    text = "\n".join([_HEADER, _DEFAULTS, *(_table(guess, domain) for guess in guesses)])
    return Draft(file, text, tuple(guesses), tuple(said))


def write(draft: Draft) -> None:
    """Write a draft, as a whole or not at all. Raises ConfigError if that fails, or if the file exists by now."""
    _refuse_existing(draft.file)
    try:
        put(draft.file, draft.text.encode())
    except OSError as error:
        message, place = f"the configuration can't be written: {error.strerror}", shown(draft.file)
        hint = "check the folder's permissions and the space on the disk, or name another file with --config"
        raise ConfigError(Diagnostic(Severity.ERROR, "config-not-written", message, place, hint=hint)) from None


def _refuse_existing(file: Path) -> None:
    if os.path.lexists(file):
        hint = "add a table `[robots.NAME]` to it, or name another file with --config"
        raise ConfigError(
            Diagnostic(Severity.ERROR, "config-exists", "the file exists already", shown(file), hint=hint)
        )


def _search(folder: Path, suffix: str) -> Iterator[Path]:
    """Files with this suffix below `folder`, hidden files and folders left out, sorted."""
    for parent, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        found = [name for name in sorted(files) if name.lower().endswith(suffix) and not name.startswith(".")]
        yield from (Path(parent, name) for name in found)


def _guess(domain: Domain, source: Path, root: Path, taken: Sequence[Guess]) -> tuple[Guess, Sequence[Diagnostic]]:
    """A robot for a source, under a name that none of the others has; with warnings. Raises SourceError."""
    path = source if source.is_absolute() and root not in source.parents else Path(os.path.relpath(source, root))
    if any(ord(char) < 32 or ord(char) == 127 or "\ud800" <= char <= "\udfff" for char in str(path)):
        message, hint = "the name of the source can't be written into a configuration", "rename it"
        raise SourceError(Diagnostic(Severity.ERROR, "source-name", message, shown(source), hint=hint))
    reading = domain.read(read_source(source), shown(source), domain.options())
    if reading.snapshot is None or any(found.severity is Severity.ERROR for found in reading.diagnostics):
        raise SourceError(*reading.diagnostics)
    stem = source.name.partition(".")[0][:_LONGEST]
    name = re.sub(r"[^a-z0-9]+", "_", stem.lower()).strip("_")
    name, package = name if is_robot_name(name) else f"robot_{name}".rstrip("_"), class_name(stem)
    names = {name for guess in taken for name in (guess.robot, guess.package.casefold())}
    counts = ("", *map(str, range(2, len(taken) + 2)))
    count = next(count for count in counts if names.isdisjoint((name + count, (package + count).casefold())))
    guess = Guess(name + count, path.as_posix(), package + count, tuple(domain.propose(reading.snapshot)))
    return guess, reading.diagnostics


def _table(guess: Guess, domain: Domain) -> str:
    """The table of a robot, with its options: those that are guessed, and the others as comments."""
    lines = [
        f"[robots.{guess.robot}]",
        _line("source", guess.source),
        _line("package", guess.package) + "  # full name, for example Plant.Robots.Arm; its last part names the class",
    ]
    if domain.name != "urdf":
        lines.append(_line("domain", domain.name))
    proposed = {proposal.option: proposal for proposal in guess.options}
    for field in msgspec.structs.fields(domain.options):
        words = in_words(field.type)
        if proposal := proposed.get(field.encode_name):
            reason = " ".join("".join(char if char.isprintable() else " " for char in proposal.reason).split())
            lines.append(f"{_line(proposal.option, proposal.value)}  # {words}; guessed: {reason}")
        elif field.default not in (msgspec.NODEFAULT, None):  # TOML has no null
            lines.append(f"# {_line(field.encode_name, field.default)}  # {words}")
    return "\n".join(lines) + "\n"


def _line(key: str, value: Any) -> str:
    plain_value = msgspec.to_builtins(value)
    if isinstance(plain_value, list | tuple):  # tomli_w gives each item a line, which can't be one comment
        items = (tomli_w.dumps({"item": item}).strip().removeprefix("item = ") for item in plain_value)
        return f"{key} = [{', '.join(items)}]"
    return tomli_w.dumps({key: plain_value}).strip()
