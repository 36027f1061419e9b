"""What later versions have to keep: the forms that people and programs rely on, and projects as a release built them.

A form is a text with one line for each thing that is promised, such as `build --check`: a later version has every line.
`python -m tests --renew` adds lines and projects, and changes none: what a release has written is a promise.
"""

from __future__ import annotations

import inspect
import json
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import urdfsync
from support import mjcfs, sdfs, xacros
from support.networks import edit
from support.urdfs import ELBOW_ARM
from urdfsync.commands.schema import document_schema
from urdfsync.common.diagnostics import IGNORABLE
from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import declared
from urdfsync.project.config import schema

ROOT = Path(__file__).parents[2]
KEPT = ROOT / "tests/kept"
_OF_A_MACHINE = "aside", "conflicts", "deps", "lock", "notes", "svg"
"""Parts of `.urdfsync` that are not committed."""
_WORDS = "title", "description", "default", "examples", "$schema", "$defs"
"""Keys of a schema that say nothing about which documents it accepts."""


# Forms


def forms() -> dict[str, str]:
    """Return the forms of this version by name of file."""
    made = {
        "functions": functions(),
        "commands": commands(),
        "configuration": accepted(json.loads(schema.text()), "", "input"),
        "documents": documents(),
        "codes": codes(),
        "library": classes(ROOT / "modelica/UrdfSync"),
    }
    return {f"{name}.txt": "".join(f"{line}\n" for line in sorted(set(lines))) for name, lines in made.items()}


def functions() -> Iterator[str]:
    """Yield a line for each parameter of each function of `urdfsync`, with its default."""
    for name in urdfsync.__all__:
        value = getattr(urdfsync, name)
        yield name
        if not inspect.isclass(value):
            for parameter in inspect.signature(value).parameters.values():
                value = getattr(parameter.default, "__name__", repr(parameter.default))
                default = "" if parameter.default is parameter.empty else f" = {value}"
                yield f"{name}: {parameter.kind.description} {parameter.name}{default}"


def commands() -> Iterator[str]:
    """Yield a line for each option and argument of each command, with its words."""
    for line in (ROOT / "urdfsync/commands/shells/options.tsv").read_text(encoding="utf-8").splitlines():
        command, option, words, *_ = line.split("\t")
        yield " ".join(filter(None, (command, option, words))) if option or words else command


def codes() -> Iterator[str]:
    """Yield the codes of the findings on their page; `ignore` and `refuse` take those that say so."""
    page = (ROOT / "docs/findings.md").read_text(encoding="utf-8")
    cells = re.findall(r"(?m)^\| ((?:`[a-z-]+`(?:, )?)+) \|", page)
    told = {code for cell in cells for code in re.findall(r"[a-z-]+", cell)}
    for code in told | IGNORABLE:
        yield f"{code}, to ignore" if code in IGNORABLE else code


def documents() -> Iterator[str]:
    """Yield a line for each key of each JSON document; a command may have the document of another one."""
    known = dict[tuple[str, ...], str]()
    for command in [line for line in commands() if " " not in line]:
        if command not in ("schema", "completion"):
            lines = (*accepted(document_schema(command), "", "output"),)
            if (first := known.setdefault(lines, command)) != command:
                yield f"{command}: as {first}"
            else:
                yield from (f"{command} {line}" for line in lines)


def accepted(given: Any, path: str, way: str) -> Iterator[str]:
    """Yield what a schema accepts (`input`) or promises (`output`): a line for each key, type and word."""
    definitions = given.get("$defs", {})

    def walk(node: Mapping[str, Any], path: str, above: Sequence[str]) -> Iterator[str]:
        if name := node.get("$ref", "").rpartition("/")[2]:
            if name not in above:  # such as an assembly of assemblies
                yield from walk(definitions[name], path, (*above, name))
            return
        for key, value in node.items():
            if key in ("anyOf", "oneOf", "allOf"):
                for one in value:
                    yield from walk(one, path, above)
            elif key == "properties":
                for name, one in value.items():
                    is_there = way == "output" and name in node.get("required", ())
                    yield f"{path} {name}{', always' if is_there else ''}"
                    yield from walk(one, f"{path} {name}", above)
            elif key in ("items", "additionalProperties", "prefixItems"):
                for one in value if isinstance(value, list) else [value]:
                    if isinstance(one, dict):
                        yield from walk(one, f"{path} *", above)
            elif key in ("enum", "const", "type"):
                for word in value if isinstance(value, list) else [value]:
                    yield f"{path}: {json.dumps(word)}"
            elif key == "required" and way == "input":
                continue  # a key that must be there may become one that need not
            elif key not in (*_WORDS, "required"):
                yield f"{path}: {key} {json.dumps(value)}"

    for line in walk(given, path, ()):
        yield line.strip()


def classes(package: Path) -> Iterator[str]:
    """Yield the names of all classes and components of a package."""
    for file in sorted(package.rglob("*.mo")):
        within, read = re.match(r"\s*within ([\w.]*);", text := file.read_text(encoding="utf-8")), parse(text)
        for one in declared(read.classes):
            yield ".".join(filter(None, (within[1] if within else "", *one.path)))


# Projects


class Project(NamedTuple):
    """A project that a release has built, with an edit."""

    files: Mapping[str, str]
    edited: str
    """The edited file below `modelica`, in which a comment `// mine` stands."""
    export: tuple[str, str, str]
    """A file of the source, a text in it, and the text of the next export."""
    is_in_conflict: bool = False


def _robot(source: str, package: str = "Arm", more: str = "") -> str:
    return f'[robots.arm]\nsource = "{source}"\npackage = "{package}"\n{more}'


_HOUSE = ROOT / "tests/formats/table/examples/thermal"
_LINK_TEMPLATE = (ROOT / "templates/urdf/link/model.mo.jinja").read_text(encoding="utf-8")
PROJECTS: Mapping[str, Project] = {
    "urdf": Project(
        {"urdfsync.toml": _robot("arm.urdf"), "arm.urdf": ELBOW_ARM},
        "Arm/Links/Fore.mo",
        ("arm.urdf", 'effort="5"', 'effort="6"'),
        is_in_conflict=True,
    ),
    "xacro": Project(
        {
            "urdfsync.toml": xacros.CONFIG,
            "urdf/arm.urdf.xacro": xacros.ARM,
            "urdf/parts/beam.xacro": xacros.BEAM,
            "urdf/masses.yaml": xacros.MASSES,
        },
        "Arm/Links/Upper.mo",
        ("urdf/masses.yaml", "1.5", "1.75"),
    ),
    "mjcf": Project(
        {"urdfsync.toml": _robot("arm.xml"), "arm.xml": mjcfs.ARM},
        "Arm/Links/Upper.mo",
        ("arm.xml", 'mass="1.5"', 'mass="1.75"'),
    ),
    "sdf": Project(
        {"urdfsync.toml": _robot("arm.sdf"), "arm.sdf": sdfs.ARM},
        "Arm/Links/Upper.mo",
        ("arm.sdf", "<mass>1.5", "<mass>1.75"),
    ),
    "record": Project(
        {"urdfsync.toml": _robot("arm.urdf", more='approach = ["record"]\n'), "arm.urdf": ELBOW_ARM},
        "Arm/ArmGeneric.mo",
        ("arm.urdf", 'value="2.5"', 'value="2.75"'),
    ),
    "templates": Project(
        {
            "urdfsync.toml": _robot("arm.urdf", more='templates = "templates"\n'),
            "arm.urdf": ELBOW_ARM,
            "templates/link/model.mo.jinja": _LINK_TEMPLATE.replace(
                "\nequation\n", '\n  Real heat = 0 "Of << record >>";\n\nequation\n'
            ),
        },
        "Arm/Links/Fore.mo",
        ("arm.urdf", 'value="2.5"', 'value="2.75"'),
    ),
    "table": Project(
        {str(file.relative_to(_HOUSE)): file.read_text(encoding="utf-8") for file in _HOUSE.rglob("*.*")},
        "House/Models/Roof.mo",
        ("house.csv", "roof,wall,,18", "roof,wall,,20"),
    ),
}


def run(folder: Path, *arguments: str, codes: Sequence[int] = (0,)) -> str:
    """Run urdfsync as a program, and return its output. Raises AssertionError for another exit code."""
    command = [sys.executable, "-m", "urdfsync", *arguments]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode in codes, f"{arguments}: {done.returncode}\n{done.stdout}{done.stderr}"
    return done.stdout


def make(project: Project, folder: Path) -> None:
    """Build a project, edit it, and build it with the next number of its source if it ends in conflict."""
    for name, text in project.files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    run(folder, "build")
    file = folder / "modelica" / project.edited
    edit(file, f"end {file.stem};", f"// mine\nend {file.stem};")
    if project.is_in_conflict:
        edit(folder / "modelica/Arm/Links/ForeParameters.mo", "2.5", "2.6")
        edit(folder / "arm.urdf", 'value="2.5"', 'value="2.75"')
    run(folder, "build", codes=(3,) if project.is_in_conflict else (0,))
    for name in _OF_A_MACHINE:
        place = folder / ".urdfsync" / name
        shutil.rmtree(place) if place.is_dir() else place.unlink(missing_ok=True)


def renew(tell: Callable[[Path], object]) -> None:
    """Add what is new in this version to the forms, and the projects that are missing."""
    for name, text in forms().items():
        file, kept = KEPT / name, set[str]()
        if file.exists():
            kept = set(file.read_text(encoding="utf-8").splitlines())
        if new := set(text.splitlines()) - kept:
            file.write_text("".join(f"{line}\n" for line in sorted(kept | new)), encoding="utf-8")
            tell(file)
    for name in PROJECTS.keys() - {folder.name for folder in KEPT.iterdir()}:
        with tempfile.TemporaryDirectory() as place:
            made = Path(place, name)
            made.mkdir()
            make(PROJECTS[name], made)
            shutil.copytree(made, KEPT / name)
        tell(KEPT / name)


def contents(folder: Path) -> dict[str, bytes]:
    """Return the files below a folder."""
    return {str(file.relative_to(folder)): file.read_bytes() for file in folder.rglob("*") if file.is_file()}
