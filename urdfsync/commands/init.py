"""`urdfsync init`: guesses a first configuration from the sources, and gives the reason of each guess."""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import msgspec
import tomli_w

from urdfsync.commands import arguments, merge_driver
from urdfsync.common import system
from urdfsync.common.diagnostics import ConfigError, Diagnostic, Severity, SourceError
from urdfsync.common.files import Tree, put, relative, shown
from urdfsync.domain import Domain, Lookup, Version, registry
from urdfsync.domain.advice import Proposal
from urdfsync.engine.judgements import judge
from urdfsync.engine.package.imports import find_dependencies, find_missing
from urdfsync.engine.result import Exit
from urdfsync.engine.sources import source as source_files
from urdfsync.modelica.names import class_name, in_ascii
from urdfsync.output.console import Console, line
from urdfsync.project import config
from urdfsync.project.config import schema
from urdfsync.project.config.load import in_words
from urdfsync.project.git.unmerged import NO_DRIVER

_HEADER = f"""\
#:schema {config.STATE_FOLDER}/{schema.SCHEMA_FILE}
# Robots that urdfsync keeps in step with their Modelica packages.
# Paths are relative to this file's folder. All other keys: docs/configuration.md of urdfsync.
"""
_LONGEST = 80
"""The greatest number of characters of a guessed name: robots and packages become names of files."""
_GENERIC = frozenset("cad description main model models robot robots src urdf xacro".split())
"""Names of sources and folders, in lower case, that name no robot."""


NamedSource: TypeAlias = tuple[Path, Mapping[str, str]]
"""A source with its arguments for xacro."""


class Guess(msgspec.Struct, frozen=True):
    """The table of one robot: a new table, or a table of the configuration."""

    KEYS = ("robot", "source", "arguments", "package", "options")

    robot: str
    source: str
    arguments: Mapping[str, str]
    package: str
    options: tuple[Proposal, ...] = ()
    templates: Mapping[str, str] = {}
    """First templates for the user, by their paths."""

    @property
    def templates_folder(self) -> str:
        """The folder for these templates."""
        return f"templates/{self.robot}"


def add(commands: arguments.Commands) -> None:
    """Add the command's parser."""
    parser = arguments.add_command(
        commands,
        "init",
        help="write a first urdfsync.toml",
        description="Write a first urdfsync.toml for some sources, with guesses and their reasons.",
        epilog="example: urdfsync init cad/arm.urdf cad/gripper.urdf",
    )
    sources = "URDF files (default: all below this folder), or xacro files, each with its arguments NAME:=VALUE"
    parser.add_argument("sources", nargs="*", metavar="SOURCE", help=sources)
    merge = "let builds merge changes into files that you edited, unless they contradict your edits"
    parser.add_argument("--merge", action="store_true", help=merge)
    driver = "let git merge models by their elements in this clone, as `urdfsync merge-driver --install`"
    parser.add_argument("--merge-driver", action="store_true", help=driver)
    parser.add_argument("--domain", default="urdf", metavar="NAME", help="format of the sources (default: %(default)s)")


def run(args: argparse.Namespace, console: Console) -> int:
    """Write the configuration, and show the guesses."""
    file = config.working_folder() / (args.config or config.FILE_NAME)
    _refuse_existing(file)
    domain = registry.domain(args.domain)
    named = arguments.split_sources(args.sources, args.parser)
    guesses, warnings = guess_robots("init", domain, file.parent, named)
    is_clone = merge_driver.can_install(file.parent)
    question = "Let git merge these models by their elements, in this clone?"
    is_asked = is_clone and not args.merge_driver and arguments.can_ask(console)
    installs = args.merge_driver or (is_asked and arguments.is_confirmed(question, "installed", console))
    if installs:
        merge_driver.install(file.parent, console)
    _refuse_existing(file)
    with write_errors(file):
        write_schema(file.parent)  # first: if writing fails, there is no configuration yet, and `init` can be repeated
        write_templates(file.parent, guesses)
        put(file, configuration_text(domain, guesses, merges=args.merge).encode())
    if is_clone and not (is_asked or installs):
        warnings.append(NO_DRIVER)
    return show_guesses(console, file, "written", guesses, warnings)


def guess_robots(
    command: str, domain: Domain, root: Path, named: Sequence[NamedSource], known: Sequence[Guess] = ()
) -> tuple[list[Guess], list[Diagnostic]]:
    """Guess a robot for each of the `named` sources, or for all sources below `root`; also return warnings.

    `known` are the existing robots. A source that is named twice with the same arguments counts once. Raises
    ConfigError without a source, and if a given name is taken. Raises SourceError if a named source is unreadable, or
    if all found ones are.
    """
    unique: dict[tuple[str, str], NamedSource] = {}
    for source, given in named or ((source, {}) for source in _search(root, f".{domain.name}")):
        unique.setdefault((os.path.realpath(source), json.dumps(given, sort_keys=True)), (source, given))
    if not unique:
        message, hint = f"no *.{domain.name} below {shown(root)}", "name the sources: `urdfsync init SOURCE`"
        raise ConfigError.of("no-source", message, hint=hint)
    guesses: list[Guess] = []
    warnings: list[Diagnostic] = []
    errors: list[Diagnostic] = []
    for source, given in unique.values():
        try:
            guess, noted = _guess(domain, source, given, root, [*known, *guesses])
        except SourceError as error:
            if named:
                raise SourceError(*(_with_argument(one, command, source, given) for one in error.diagnostics)) from None
            errors += error.diagnostics
            first = next(one for one in error.diagnostics if one.severity is Severity.ERROR)
            hint = f"correct the source and add it, or run `urdfsync init {shown(source)}`"
            message = f"{first.message}; left out"
            warnings.append(msgspec.structs.replace(first, severity=Severity.WARNING, message=message, hint=hint))
        else:
            guesses.append(guess)
            warnings += (each for each in noted if each.severity is not Severity.NOTE)  # the first build shows notes
    if not guesses:
        raise SourceError(*errors)
    return guesses, warnings


def _with_argument(finding: Diagnostic, command: str, source: Path, given: Mapping[str, str]) -> Diagnostic:
    """Return the finding; for unset arguments of xacro, its hint is the command with these arguments."""
    if finding.code != "no-argument":
        return finding
    name = _names(next(iter(given.values()), "") or source.name.partition(".")[0])[0]
    unset = {one: name if one == "name" else "VALUE" for one in re.findall(r"`([^`]+)`", finding.message)}
    words = [str(source), *(f"{key}:={value}" for key, value in {**given, **unset}.items())]
    return msgspec.structs.replace(finding, hint=f"run `urdfsync {command} {system.join_words(words)}`")


def _search(folder: Path, suffix: str) -> Iterator[Path]:
    """Yield the files with this suffix below `folder`, without hidden files and folders."""
    for parent, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if not name.startswith("."))
        sources = [name for name in sorted(files) if name.lower().endswith(suffix) and not name.startswith(".")]
        yield from (Path(parent, name) for name in sources)


def _guess(
    domain: Domain, source: Path, given: Mapping[str, str], root: Path, known: Sequence[Guess]
) -> tuple[Guess, Sequence[Diagnostic]]:
    """Return a robot for a source, under free names; also warnings. Raises SourceError, ConfigError."""
    path = source if source.is_absolute() and root not in source.parents else Path(relative(source, root))
    if any(ord(char) < 32 or ord(char) == 127 or "\ud800" <= char <= "\udfff" for char in str(path)):
        message, hint = "the name of the source can't be written into a configuration", "rename it"
        raise SourceError.of("source-name", message, shown(source), hint=hint)
    text = source_files.read_file_source(domain, source, given, config.ros_package_path())
    advice = domain.advice
    if text.expansion and "name" in text.expansion.unused:  # then `name` is only the robot's name in the configuration
        others = {key: value for key, value in given.items() if key != "name"}
        text = source_files.read_file_source(domain, source, others, config.ros_package_path())
    snapshot, reading = source_files.read_permissively(domain, text)
    values = text.expansion.arguments if text.expansion else {}
    is_generic = source.name.partition(".")[0].lower() in _GENERIC
    own_name = str(getattr(snapshot, "name", "")) if text.expansion or is_generic else ""
    fleet = [one.arguments for one in known if (root / one.source).resolve() == source.resolve()]
    robot, package = _free_names(source, given, own_name, fleet, known)
    proposals = tuple(advice.propose(snapshot, reading.diagnostics)) if advice else ()
    found = {companion.option for companion in text.companions}
    for kind, beside in source_files.companions_beside(domain, path):
        if kind.option in found:
            proposals += (Proposal(kind.option, beside.as_posix(), "the file stands beside the source"),)
    templates = domain.starter(snapshot) if domain.starter else {}
    guess = Guess(robot, path.as_posix(), values, package, proposals, templates)
    judged = judge(domain, Version(snapshot), reading, text.name)
    settled = {proposal.settles for proposal in proposals}
    of_source = [finding for finding in reading.diagnostics if finding.code not in settled]
    lookup = Lookup(Path(os.path.normpath(config.working_folder() / source)), config.ros_package_path())
    imports = find_dependencies(domain, snapshot, lookup, domain.permissive_options, reading.lines)
    missing = find_missing(imports, text.name)
    return guess, (*text.diagnostics, *map(text.locate, (*of_source, *judged, *missing)))


def _free_names(
    source: Path, given: Mapping[str, str], own_name: str, fleet: Sequence[Mapping[str, str]], known: Sequence[Guess]
) -> tuple[str, str]:
    """Return names for a robot and its package that no `known` robot has.

    The argument `name` decides. Otherwise the robot's own name is tried first. Next comes this name with the arguments
    that differ within the `fleet` of its source, then the file's name. Names such as `model` come last, after the
    folder's name. Raises ConfigError if the argument `name` is taken.
    """
    taken = {name.casefold() for one in known for name in (one.robot, one.package)}
    differing = "_".join(value for key, value in given.items() if any(other.get(key) != value for other in fleet))
    if own_name.lower() not in differing.lower():
        differing = f"{own_name}_{differing}"
    texts = [own_name, differing if fleet else "", source.name.partition(".")[0]]
    folders = [folder.name for folder in source.resolve().parents if folder.name.lower() not in _GENERIC]
    texts = [text for text in texts if text and text.lower() not in _GENERIC] or [*folders[:1], *texts]
    texts = [given["name"]] if given.get("name") else texts
    names = [_names(text[:_LONGEST]) for text in texts if text]
    free = next((pair for pair in names if taken.isdisjoint(map(str.casefold, pair))), None)
    if free is None and given.get("name"):
        message, hint = f"another robot or package has the name `{given['name']}`", "give another name with `name:=`"
        raise ConfigError.of("source-in-use", message, shown(source), hint=hint)
    robot, package = names[-1]
    counts = map(str, range(2, len(taken) + 3))
    return free or next(
        (robot + count, package + count)
        for count in counts
        if taken.isdisjoint((robot + count, (package + count).casefold()))
    )


def _names(text: str) -> tuple[str, str]:
    """Return names of a robot and of its package, which are made from any text."""
    name = re.sub(r"[^a-z0-9]+", "_", in_ascii(text).lower()).strip("_")
    return name if config.is_robot_name(name) else f"robot_{name}".rstrip("_"), class_name(text)


def configuration_text(domain: Domain, guesses: Sequence[Guess], *, merges: bool) -> str:
    """Return a configuration; `merges`: builds may merge edited files."""
    defaults = ['[defaults]\non_conflict = "merge"\n'] if merges else []
    return "\n".join([_HEADER, *defaults, *(robot_table(guess, domain) for guess in guesses)])


def robot_table(guess: Guess, domain: Domain) -> str:
    """Return the table of a robot, with guessed options."""
    lines = [
        f"[robots.{guess.robot}]",
        _assignment("source", guess.source),
        *([_assignment("arguments", guess.arguments)] if guess.arguments else []),
        _assignment("package", guess.package)
        + "  # full name, for example Plant.Robots.Arm; its last part names the class",
    ]
    if domain.name != "urdf":
        lines.append(_assignment("domain", domain.name))
    if guess.templates:
        lines.append(_assignment("templates", guess.templates_folder))
    types = {field.encode_name: field.type for field in msgspec.structs.fields(domain.options)}
    for proposal in guess.options:
        reason = " ".join("".join(char if char.isprintable() else " " for char in proposal.reason).split())
        words = f"{in_words(types[proposal.option])}; guessed: {reason}"
        lines.append(f"{_assignment(proposal.option, proposal.value)}  # {words}")
    return "\n".join(lines) + "\n"


def write_templates(root: Path, guesses: Sequence[Guess]) -> None:
    """Write the templates of new robots. Raises ConfigError for templates that exist already, and OSError."""
    texts = {root / one.templates_folder / path: text for one in guesses for path, text in one.templates.items()}
    for file in texts:
        if file.exists():
            raise ConfigError.of("template-exists", "the template exists already", shown(file), hint="move it away")
    for file, text in texts.items():
        file.parent.mkdir(parents=True, exist_ok=True)
        put(file, text.encode())


def _assignment(key: str, value: Any) -> str:
    plain_value = msgspec.to_builtins(value)
    if isinstance(plain_value, dict):
        return f"{key} = {{ {', '.join(_assignment(*item) for item in plain_value.items())} }}"
    if isinstance(plain_value, list | tuple):  # one line for the comment; tomli_w writes a line for each item
        items = (tomli_w.dumps({"item": item}).strip().removeprefix("item = ") for item in plain_value)
        return f"{key} = [{', '.join(items)}]"
    return tomli_w.dumps({key: plain_value}).strip()


@contextlib.contextmanager
def write_errors(file: Path) -> Iterator[None]:
    """Turn an OSError of writing the configuration into a ConfigError."""
    try:
        yield
    except OSError as error:
        message, place = f"the configuration can't be written: {error.strerror}", shown(file)
        hint = "check the folder's permissions and the space on the disk, or name another file with --config"
        raise ConfigError.of("config-not-written", message, place, hint=hint) from None


def write_schema(root: Path) -> None:
    """Write the schema that editors read, beside the recorded state. Raises OSError, OutputError."""
    folder = root / config.STATE_FOLDER
    if not Tree(root).check_folder(folder):
        folder.mkdir()
    put(folder / schema.SCHEMA_FILE, schema.text().encode())


def _refuse_existing(file: Path) -> None:
    if os.path.lexists(file):
        hint = "`urdfsync add SOURCE` adds a robot to this file; or name another file with --config"
        raise ConfigError.of("config-exists", "the file exists already", shown(file), hint=hint)


def show_guesses(
    console: Console, file: Path, done: str, guesses: Sequence[Guess], warnings: Sequence[Diagnostic]
) -> int:
    """End a command: show what was `done` to the configuration, each guess with its reason, and the warnings."""
    lines = [line((shown(file), "bold"), (f" {done}", ""))]
    for guess in guesses:
        name, package = (guess.robot, "bold"), (guess.package, "bold")
        lines.append(line(("  ", ""), name, (f": {guess.source} becomes package ", ""), package))
        for option in guess.options:
            assignment = f"    {option.option} = {json.dumps(option.value)}"
            lines.append(line((assignment, ""), (f"  guessed: {option.reason}", "dim")))
    console.tell([*lines, line(("Look it over, then run `urdfsync build`.", ""))])
    for guess in guesses:
        console.add(guess)
    return console.end(Exit.IN_STEP, warnings)
