"""A robot's source, in bytes and as a model, and its templates."""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import Any

import msgspec

from urdfsync.config import Config, RobotConfig, templates_folder
from urdfsync.dependencies import is_folder, read_file
from urdfsync.diagnostics import ConfigError, Diagnostic, Severity, SourceError
from urdfsync.domain import Domain, Reading, Snapshot, Templates
from urdfsync.files import kind_of, shown, templates_digest

MAX_TEMPLATE = 10_000_000
"""Bytes of a file in a template folder of the user's; the longest template of urdfsync has 5,000."""


def read_source(config: Config, robot: RobotConfig) -> bytes:
    """The content of the robot's source. Raises SourceError at the line of the configuration that names it."""
    try:
        if stat.S_ISREG(robot.source.stat().st_mode):
            return read_file(robot.source)
        reason = f"is {kind_of(robot.source.stat().st_mode)}"
    except OSError as error:
        reason = "does not exist" if isinstance(error, FileNotFoundError) else f"can't be read: {error.strerror}"
    message = f"robot `{robot.name}`: the source {shown(robot.source)} {reason}"
    line = robot.lines.get("source", 0)
    hint = "correct `source`, or export the file again"
    raise SourceError(Diagnostic(Severity.ERROR, "no-source", message, shown(config.file), line, hint=hint))


def templates(config: Config, robot: RobotConfig, domain: Domain) -> Templates:
    """Return the robot's templates: those in its own folder hide the domain's. Raises ConfigError for a bad folder."""
    folders = [robot.templates] if robot.templates else []
    for folder in folders:
        if not is_folder(folder):
            message = f"robot `{robot.name}`: the template folder {shown(folder)} does not exist"
            line, hint = robot.lines.get("templates", 0), "create it, or take `templates` out"
            raise ConfigError(Diagnostic(Severity.ERROR, "no-templates", message, shown(config.file), line, hint=hint))
        _check_templates(folder)
    return domain_templates(domain, *folders)


def domain_templates(domain: Domain, *own: Path) -> Templates:
    """Return the templates of a domain, behind folders of the user's own whose files hide them."""
    folders = (*own, templates_folder(domain))
    return Templates(folders, templates_digest(folders))


def _check_templates(folder: Path) -> None:
    """Refuse links that lead out of a template folder, and files that are too large to be templates.

    The files may be a stranger's. Raises ConfigError.
    """
    for place, folders, files in os.walk(folder):
        for path in (Path(place, name) for name in (*folders, *files)):
            if path.is_symlink() and not path.resolve().is_relative_to(folder.resolve()):
                message = "the link leads out of the template folder"
                hint = "put a copy of what it leads to in its place"
            elif path.is_file() and path.stat().st_size > MAX_TEMPLATE:
                message = f"the file has more than {MAX_TEMPLATE:,} bytes, which is too large for a template"
                hint = "move it out of the template folder"
            elif path.exists() and not (path.is_file() or path.is_dir()):  # reading a FIFO would never end
                message = f"this is {kind_of(path.stat().st_mode)}, and so no template"
                hint = "move it out of the template folder"
            else:
                continue
            raise ConfigError(Diagnostic(Severity.ERROR, "template", message, shown(path), hint=hint))


def check_options(config: Config, robot: RobotConfig, domain: Domain, snapshot: Snapshot) -> tuple[Diagnostic, ...]:
    """What the domain says of the robot's options, now that there is a model, at their lines in the configuration.

    Raises ConfigError with every option that does not suit the model.
    """
    found = tuple(
        msgspec.structs.replace(
            said,
            message=f"robot `{robot.name}`: {said.message}",
            file=shown(config.file),
            line=robot.lines.get(option, robot.lines[""]),
        )
        for option, said in domain.check_options(snapshot, robot.options)
    )
    if errors := [said for said in found if said.severity is Severity.ERROR]:
        raise ConfigError(*sorted(errors, key=lambda error: error.line))
    return found


def read(domain: Domain, options: Any, content: bytes, name: str) -> tuple[Snapshot, Reading]:
    """Return the model in a source, and all that was read; `name` is how diagnostics call the source.

    Raises SourceError with all that is wrong in it.
    """
    reading = domain.read(content, name, options)
    if reading.snapshot is None or any(found.severity is Severity.ERROR for found in reading.diagnostics):
        raise SourceError(*reading.diagnostics)
    return reading.snapshot, reading
