"""Decides whether the user trusts a configuration that leads out of its own folder."""

from __future__ import annotations

import os
from pathlib import Path

import msgspec

from urdfsync.common import system
from urdfsync.common.dependencies import reads
from urdfsync.common.diagnostics import ConfigError, Diagnostic, Severity
from urdfsync.common.files import shown
from urdfsync.project.config import tomlfile
from urdfsync.project.config.settings import Config, RobotConfig


class _Trusted(msgspec.Struct, forbid_unknown_fields=True):
    """The user's file of trusted folders."""

    folders: list[str] = []


def find_untrusted_output(config: Config, robot: RobotConfig) -> Diagnostic | None:
    """Return an error if a robot's output is outside of the configuration's folder and not trusted.

    Raises ConfigError if the user's file of trusted folders can't be read. That file is no part of a repository.
    """
    if robot.output.is_relative_to(config.root):
        return None
    message = f"`output` leads out of the configuration's folder, to {robot.output}"  # the user has to see the path
    return _find_untrusted(config, message, robot.lines.get("output", 0))


def find_untrusted_command(config: Config, robot: RobotConfig) -> Diagnostic | None:
    """Return an error if a robot has a command in an untrusted folder. Reads the user's file of trusted folders.

    Raises ConfigError if this file can't be read.
    """
    message = f"robot `{robot.name}`: its `command` was not run: {system.join_words(robot.command)}"
    return _find_untrusted(config, message, robot.lines.get("command", 0), "untrusted-command")


def find_untrusted_compiler(config: Config, compiler: str, title: str) -> Diagnostic | None:
    """Return an error if the configuration of an untrusted folder chooses a compiler, or its program.

    Raises ConfigError. Models and libraries have external functions, by which a compiler may run other programs.
    """
    key, reason = "tool", "models can start programs through this compiler"
    if program := config.check.program(compiler):
        key, reason = compiler, program
    message = f"`{key}` in the table `[check]`: {title} was not run: {reason}"
    return _find_untrusted(config, message, config.check_lines.get(key, 0), "untrusted-command")


def _find_untrusted(config: Config, message: str, line: int, code: str = "untrusted-output") -> Diagnostic | None:
    """Return an error with this message if the configuration's folder is not trusted. Raises ConfigError."""
    import platformdirs  # takes 6 ms, and few configurations write outside of their folder

    file = platformdirs.user_config_path("urdfsync", appauthor=False) / "trusted.toml"
    entry = f'`folders = ["{config.root.as_posix()}"]`'
    try:
        text = reads.read_file(file).decode()
        folders = msgspec.convert(tomlfile.parse(text, str(file), ConfigError), _Trusted).folders
    except FileNotFoundError:
        folders = []
    except (OSError, UnicodeDecodeError, msgspec.ValidationError) as error:
        message = f"the file of trusted folders can't be used: {error}"
        hint = f"write {entry}, in UTF-8"
        raise ConfigError.of("trusted-folders", message, str(file), hint=hint) from None
    if os.path.realpath(config.root) in {os.path.realpath(Path(folder).expanduser()) for folder in folders}:
        return None
    hint = f"if you trust this configuration, use --trust, or write {entry} into {file}"
    return Diagnostic(Severity.ERROR, code, message, shown(config.file), line, hint=hint)
