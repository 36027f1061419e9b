"""A first `urdfsync.toml`: guessed from the sources, commented, and with the reason of every guess."""

from __future__ import annotations

import dataclasses
import os
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import msgspec
import tomli_w

from urdfsync import modelica, registry, tables
from urdfsync.config import is_robot_name, shown
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity, SourceError
from urdfsync.domain import Domain, Proposal
from urdfsync.manifest import plain

_HEADER = """\
# Robots that urdfsync keeps in step with their Modelica packages.
# Paths count from this file's folder. `urdfsync build` builds all of them.
"""
_DEFAULTS = """\
# Settings for all robots; a robot's own table wins.
[defaults]
output = "modelica"  # the folder that the packages go into
# create_parents = true  # make the packages around `package` if they do not exist
# package_paths = []  # folders that hold packages, where sources refer to files in them
# templates = "templates"  # a folder with templates that replace single ones of urdfsync
"""


@dataclasses.dataclass(frozen=True, slots=True)
class Guess:
    """What is proposed for one robot."""

    robot: str
    source: str
    package: str
    options: tuple[Proposal, ...]


@dataclasses.dataclass(frozen=True, slots=True)
class Draft:
    """A configuration that is not written yet."""

    file: Path
    text: str
    guesses: tuple[Guess, ...]
    diagnostics: tuple[Diagnostic, ...]
    """Warnings about the sources."""


def draft(file: Path, sources: Sequence[Path], domain_name: str) -> Draft:
    """The configuration `file` for these sources, or for those that are below its folder if none is given.

    Raises ConfigError if the file exists or if there is no source, SourceError if one can't be read.
    """
    if file.exists():
        hint = "add a table `[robots.NAME]` to it, or name another file with --config"
        raise ConfigError(
            Diagnostic(Severity.ERROR, "config-exists", "the file exists already", shown(file), hint=hint)
        )
    domain = registry.domain(domain_name)
    sources = sources or list(_search(file.parent, f".{domain.name}"))
    if not sources:
        message, hint = f"no *.{domain.name} below {file.parent}", "name the sources: `urdfsync init SOURCE`"
        raise ConfigError(Diagnostic(Severity.ERROR, "no-source", message, hint=hint))
    guesses: list[Guess] = []
    said: list[Diagnostic] = []
    for source in sources:
        options, diagnostics = _propose(domain, source)
        said += diagnostics
        guesses.append(_guess(file.parent, source, options, guesses))
    return Draft(file, _text(guesses, domain), tuple(guesses), tuple(said))


def write(proposal: Draft) -> None:
    """Write a draft. Raises ConfigError if that is not possible, or if the file exists by now."""
    try:
        with proposal.file.open("x", encoding="utf-8", newline="\n") as file:
            file.write(proposal.text)
    except OSError as error:
        message = f"the configuration can't be written: {error.strerror}"
        raise ConfigError(Diagnostic(Severity.ERROR, "config-not-written", message, shown(proposal.file))) from None


def _search(folder: Path, suffix: str) -> Iterator[Path]:
    """Files with this suffix below `folder`, hidden folders left out, sorted."""
    for parent, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        yield from (Path(parent, name) for name in sorted(files) if name.lower().endswith(suffix))


def _propose(domain: Domain, source: Path) -> tuple[tuple[Proposal, ...], list[Diagnostic]]:
    try:
        content = source.read_bytes()
    except OSError as error:
        message = f"the source can't be read: {error.strerror}"
        raise SourceError(Diagnostic(Severity.ERROR, "no-source", message, shown(source))) from None
    reading = domain.read(content, shown(source), domain.options())
    errors = [found for found in reading.diagnostics if found.severity is Severity.ERROR]
    if errors or reading.snapshot is None:
        raise SourceError(*reading.diagnostics)
    return tuple(domain.propose(plain(reading.snapshot))), list(reading.diagnostics)


def _guess(root: Path, source: Path, options: tuple[Proposal, ...], taken: Sequence[Guess]) -> Guess:
    stem = source.name.partition(".")[0]
    count = "" if _is_free(stem, "", taken) else next(str(n) for n in range(2, 10_000) if _is_free(stem, str(n), taken))
    path = source if source.is_absolute() and root not in source.parents else Path(os.path.relpath(source, root))
    return Guess(_robot_name(stem) + count, path.as_posix(), modelica.class_name(stem) + count, options)


def _is_free(stem: str, count: str, taken: Sequence[Guess]) -> bool:
    robot, package = _robot_name(stem) + count, (modelica.class_name(stem) + count).casefold()
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
        elif field.default is not msgspec.NODEFAULT:
            lines.append(f"# {_line(field.encode_name, field.default)}{_comment(field.type)}")
    return "\n".join(lines) + "\n"


def _line(key: str, value: Any) -> str:
    return tomli_w.dumps({key: msgspec.to_builtins(value)}).strip()


def _choices(kind: Any) -> str:
    allowed = tables.choices(kind)
    return " or ".join(f'"{choice}"' for choice in allowed) + "; " if allowed else ""


def _comment(kind: Any) -> str:
    choices = _choices(kind).removesuffix("; ")
    return f"  # {choices}" if choices else ""
