"""Random edits of a package: what means nothing is found, nothing else is, and a compiler agrees.

Harmless edits, and at most one of them that is wrong. Left out is what only a compiler can tell that reads the Modelica
Standard Library: a modifier of one of its components, and a name that a class may inherit from there.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from pathlib import Path
from random import Random
from typing import NamedTuple

import pytest
from support import corpus
from support.cases import CASES
from support.commands import Execute
from support.modelica import CACHE, URDFSYNC
from support.urdfs import ELBOW_ARM

from urdfsync.analysis.checks import libraries
from urdfsync.analysis.checks.compilers import omc, rumoca
from urdfsync.analysis.checks.compilers.compiler import CompileJob, CompileTask
from urdfsync.engine.decide import fit
from urdfsync.modelica.lexer import lex
from urdfsync.modelica.statements import EditedStatements, compare

MODELS, RECORDS = (
    ("Arm.mo", "Links/Fore.mo", "Joints/Elbow.mo"),
    ("Links/ForeParameters.mo", "Joints/ElbowParameters.mo"),
)
SEEDS = [str(Random().random()) for _ in range(CASES)] if CASES else [str(seed) for seed in range(8)]

_LINK = "inner Modelica.Mechanics.MultiBody.World world; Arm.Links.Fore fore;"
_JOINT = f"{_LINK} Arm.Joints.Elbow elbow; equation connect(elbow.frame_b, fore.frame_a);"
BENCHES = {
    "Arm.mo": "extends Arm.ArmTest;",
    "Links": f"{_LINK} equation connect(world.frame_b, fore.frame_a);",
    "Joints": f"{_JOINT} connect(world.frame_b, elbow.frame_a);",
}
"""The models that are compiled, by the edited file or its folder: the smallest that use it."""


class Edit(NamedTuple):
    """A file of the package after some edits."""

    path: str
    text: str
    kind: str
    """What is wrong; empty if nothing is."""
    harmless: tuple[str, ...]


# --- edits that mean something ------------------------------------------------------------------------------------


def _blocks(text: str) -> tuple[str, list[str], str]:
    """Return the head of a class with what it extends, its declarations, and all from the equations on."""
    end = text.index("\nequation\n")
    head, *blocks = text[:end].strip("\n").split("\n\n")
    first = next(number for number, block in enumerate(blocks) if "  extends " not in block)
    return "\n\n".join([head, *blocks[:first]]), blocks[first:], text[end:]


def _with_block(random: Random, text: str, block: str) -> str:
    head, blocks, tail = _blocks(text)
    blocks.insert(random.randint(0, len(blocks)), block)
    return "\n\n".join([head, *blocks]) + "\n" + tail


def _new_name(random: Random, text: str) -> str:
    return next(name for _ in iter(int, 1) if (name := f"added{random.randrange(1000)}") not in text)


def comment(random: Random, text: str) -> str:
    """A comment in a line of its own."""
    lines = text.split("\n")
    body = [number for number, line in enumerate(lines) if line.startswith("  ") and "<" not in line]
    lines.insert(random.choice(body), "  // as measured (twice; end")
    return "\n".join(lines)


def number(random: Random, text: str) -> str:
    """Another value in a record."""
    place = random.choice(list(re.finditer(r" = (\d[\d.]*)", text)))
    return f"{text[: place.start(1)]}{random.randint(1, 9)}.5{text[place.end(1) :]}"


def component(random: Random, text: str) -> str:
    """A component of a class that is there."""
    name = _new_name(random, text)
    choices = (
        f'  Modelica.Blocks.Sources.Constant {name}(k = 1)\n    "Added";',
        f"  parameter Real {name} = 1;",
        f"  parameter UrdfSync.Records.Inertia {name}(ixx = 2);",
        f"  parameter Links.ForeParameters {name}(inertial(mass = 3));",
    )
    return _with_block(random, text, random.choice(choices))


def equation(random: Random, text: str) -> str:
    """A variable with its equation."""
    name = _new_name(random, text)
    declared = _with_block(random, text, f"  Real {name};")
    return declared.replace("\nequation\n", f"\nequation\n  {name} = 2*time;\n")


def imported(random: Random, text: str) -> str:
    """Components of classes that are imported."""
    name = _new_name(random, text)
    choices = (
        f"  import SI = Modelica.Units.SI;\n  parameter SI.Mass {name} = 1;",
        f"  import Modelica.Units.SI;\n  parameter SI.Mass {name} = 1;",
        f"  import Modelica.Blocks;\n  Blocks.Sources.Constant {name}(k = 1);",
        f"  import UrdfSync.Records.*;\n  parameter Inertia {name}(ixx = 2);",
    )
    return text if "  import " in text else _with_block(random, text, random.choice(choices))


def library_imported(random: Random, text: str) -> str:
    """A component of a class of a library that is not read; whatever else a name means may be there, too."""
    name = _new_name(random, text)
    return _with_block(random, text, f"  import Modelica.Blocks.Sources.*;\n  Constant {name}(k = 1);")


def order(random: Random, text: str) -> str:
    """Declarations in another order."""
    head, blocks, tail = _blocks(text)
    random.shuffle(blocks)
    return "\n\n".join([head, *blocks]) + "\n" + tail


HARMLESS: Mapping[str, Callable[[Random, str], str]] = {
    "comment": comment,
    "number": number,
    "component": component,
    "equation": equation,
    "imported": imported,
    "library imported": library_imported,
    "order": order,
}


# --- edits that mean nothing --------------------------------------------------------------------------------------


def _misspelled(random: Random, text: str, places: str) -> str:
    """Return a text in which one of the names that are a group of the pattern `places` is another one."""
    body = text.rfind("\n  annotation (")
    place = random.choice([match for match in re.finditer(places, text, re.MULTILINE) if match.end() < body])
    group = place.lastindex or 0
    word, start = place[group], place.start(group)
    spot = random.randrange(len(word))
    others = (f"{word[:spot]}{word[spot + 1 :]}", f"{word}{word[-1]}", f"{word}2", f"my{word}", "nowhere")
    known = {*re.findall(r"\w+", text), ""}
    name = random.choice([other for other in others if other not in known and not other[:1].isdigit()])
    return f"{text[:start]}{name}{text[start + len(word) :]}"


def syntax(random: Random, text: str) -> str:
    """A token that is left out, or a keyword that is misspelled."""
    if random.random() < 0.3:
        word = random.choice([word for word in ("equation", "end", "model", "record", "within") if f"{word} " in text])
        return text.replace(f"{word} ", f"{word[::-1]} ", 1)
    tokens = [token for token in lex(text)[0] if token.text in (";", "(", ")", "{", "}", "=")]
    token = random.choice(tokens)
    return text[: token.start] + text[token.start + 1 :]


def emptied(random: Random, text: str) -> str:
    """Nothing, or next to nothing."""
    return random.choice(("", "\n", "// later\n", text.partition("\n")[0] + "\n"))


def class_name(random: Random, text: str) -> str:
    """Another name of the class."""
    name = re.search(r"^end (\w+);", text, re.MULTILINE)[1]  # type: ignore[index]  # all have one
    other = random.choice((f"{name}2", f"My{name}", name.lower()))
    return re.sub(rf"^(model|record|end) {name}\b", rf"\1 {other}", text, flags=re.MULTILINE)


def within(random: Random, text: str) -> str:
    """Another package, or none."""
    first, rest = text.split("\n", 1)
    others = ("", "within ;", "within Arm;", "within Arm.Link;", "within Arm.Links.More;")
    return f"{random.choice([other for other in others if other != first])}\n{rest}"


def base(random: Random, text: str) -> str:
    """A class to extend that is not there."""
    name = random.choice(("Nowhere.To.Be", "Arm.Links.Nowhere", "UrdfSync.Nowhere.PartialLink", "Arm.Nowhere.To.Be"))
    return re.sub(r"(\n  extends )", rf"\n  extends {name};\1", text, count=1)


def removed(random: Random, text: str) -> str:
    """A connector that the benches use, taken away with its connection."""
    name = random.choice(("elbowAxis", "elbowSupport"))
    without = re.sub(rf"  Modelica\.Mechanics\.Rotational\.Interfaces\.Flange_\w {name}\n(?:.+\n)+\n", "", text)
    return re.sub(rf"  connect\(elbow\.\w+, {name}\)\n(?:.*[^;]\n)*.*;\n", "", without)


WRONG: Mapping[str, Callable[[Random, str], str]] = {
    "syntax": syntax,
    "emptied": emptied,
    "class name": class_name,
    "within": within,
    "base": base,
}
"""Of any file."""
REMOVED = {"removed": removed}
PLACES: Mapping[str, Mapping[str, str]] = {
    "Arm.mo": {
        "component": r"(?:connect\(|, |^    )(base|fore|elbow)\.",
        "connector": r"(?:base|fore)\.(\w+)",
        "class": r"(?:Links|Joints)\.(\w+)|UrdfSync\.\w+\.(\w+)",
        "middle part": r"UrdfSync\.(\w+)\.",
        "package": r" (Links|Joints)\.",
        "library": r"(UrdfSync)\.",
        "modifier": r"^    (animation|showCollisions|fixedStart|checkLimits) =",
        "value": r"= (animation|showCollisions|fixedStart|checkLimits)[,)]",
    },
    "Links/Fore.mo": {
        "component": r"(I)\[\d|connect\(\w+, (body)\.",
        "class": r"UrdfSync\.\w+\.(\w+)",
        "sibling": r"redeclare (\w+)",
        "middle part": r"UrdfSync\.(\w+)\.",
        "library": r"(UrdfSync)\.",
        "redeclared": r"redeclare \w+ (\w+)",
        # no compiler looks into `noBody`, which a link with a mass does not have
        "field": r"(?<!noBody\(m = )parameters\.(?:inertial\.)?(?:origin\.|inertia\.)?(\w+)",
    },
    "Joints/Elbow.mo": {
        "class": r"UrdfSync\.\w+\.(\w+)",
        "sibling": r"redeclare (\w+)",
        "middle part": r"UrdfSync\.(\w+)\.",
        "library": r"(UrdfSync)\.",
        "field": r"parameters\.(?:limits\.|origin\.)?(\w+)",
    },
    "Links/ForeParameters.mo": {
        "class": r"UrdfSync\.\w+\.(\w+)",
        "middle part": r"UrdfSync\.(\w+)\.",
        "library": r"(UrdfSync)\.",
        "value of a field": r"^ +(\w+) =",
        "field of a field": r"^ +(\w+)\(",
    },
    "Joints/ElbowParameters.mo": {
        "class": r"UrdfSync\.\w+\.(\w+)",
        "middle part": r"UrdfSync\.(\w+)\.",
        "library": r"(UrdfSync)\.",
        "value of a field": r"^ +(\w+) =",
        "field of a field": r"^ +(\w+)\(",
    },
}
"""Names to misspell in each file, by the kind of what they name."""

LENIENT = ("value of a field", "field of a field", "modifier", "redeclared", "removed")
"""Kinds of which rumoca 0.10.2 accepts some: modifiers of what is not there, connections to a connector that is not."""
RECORDED = corpus.FOLDER.parent / "omc" / "unknown-modifier"
"""What OpenModelica answered to such a modifier."""


def random_edit(random: Random, texts: Mapping[str, str]) -> Edit:
    """Edit one file of a package a few times."""
    path, is_wrong = random.choice((*MODELS, *RECORDS)), random.random() < 0.65
    names = ["comment", *(("number",) if path in RECORDS else ("component", "equation", "imported", "order"))]
    harmless = random.choices(names, k=random.randint(0, 3))
    if not (is_wrong or path in RECORDS or random.random() < 0.8):
        harmless = ["library imported"]
    text = texts[path]
    for name in harmless:
        text = HARMLESS[name](random, text)
    if not is_wrong:
        return Edit(path, text, "", tuple(harmless))
    wrong = {**WRONG, **(REMOVED if path == "Arm.mo" else {})}
    kind = random.choice([*wrong, *PLACES[path], *PLACES[path]])
    if kind in wrong:
        return Edit(path, wrong[kind](random, text), kind, tuple(harmless))
    return Edit(path, _misspelled(random, text, PLACES[path][kind]), kind, tuple(harmless))


@pytest.fixture
def project(folder: Path, execute: Execute) -> Path:
    """A robot that is built; its folder."""
    Path("arm.urdf").write_text(ELBOW_ARM)
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    execute("build", "--quiet")
    return folder


@pytest.fixture
def refusal(modelica_library: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], str]:
    """A function that compiles the model for an edited file; returns what the compiler has against it.

    What rumoca accepts is shown to OpenModelica, where there is one.
    """
    parts = {**libraries.find_standard_library(), "UrdfSync": URDFSYNC}
    for name, value in rumoca.environment(str(CACHE.compiler), str(tmp_path)).items():
        monkeypatch.setenv(name, value)

    def compile_bench(path: str) -> str:
        imports = "import Modelica; import UrdfSync; import Arm;"
        bench = BENCHES[path if path in BENCHES else path.partition("/")[0]]
        task = CompileTask("Bench", f"model Bench\n  {imports}\n  {bench}\nend Bench;\n")
        package = tmp_path / "modelica/Arm"
        texts = (*libraries.library_texts(package).values(), task.source.encode())
        roots = (str(libraries.copy_named(parts, texts, CACHE)), str(package))
        (result,) = rumoca.work(CompileJob(roots, (task,)))
        if not result.problem and omc.program(""):
            (result,) = omc.work(CompileJob(roots, (task,)))
        return result.problem

    return compile_bench


def edit_package(project: Path, seed: str) -> Edit:
    """Edit a file of the package on disk."""
    package = project / "modelica/Arm"
    texts = {path: (package / path).read_text() for path in (*MODELS, *RECORDS)}
    edit = random_edit(Random(seed), texts)
    (package / edit.path).write_text(edit.text)
    return edit


def errors(edit: Edit, execute: Execute) -> list[str]:
    """What `status` and `build --check` have against the package, which is the same."""
    said = []
    for command in (["status", "--format=json"], ["build", "--check", "--format=json"]):
        printed = execute(*command, code=None)
        (robot,) = printed.json["results"]
        found = [one for one in robot["diagnostics"] if one["severity"] == "error"]
        assert {one["file"] for one in found} <= {f"modelica/Arm/{edit.path}"}, edit
        assert (printed.code == 0) is robot["in_step"] is (not found), edit
        said.append([f"{one['line']}: {one['message']}" for one in found])
    assert said[0] == said[1]
    return said[0]


@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_wrong_is_found_and_nothing_else(
    project: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch, seed: str
) -> None:
    """A look at what is edited finds what one at all finds."""
    edit = edit_package(project, seed)
    found = errors(edit, execute)
    assert bool(found) is bool(edit.kind), (edit.kind, edit.path, edit.harmless, found, edit.text)

    def compare_whole(mine: str, generated: str) -> EditedStatements:
        return compare(mine, generated)._replace(same=frozenset(), is_whole=True)

    monkeypatch.setattr(fit, "compare", compare_whole)
    assert errors(edit, execute) == found


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS if CASES else SEEDS[:4])
def test_a_compiler_refuses_what_is_found_and_nothing_else(
    project: Path, execute: Execute, refusal: Callable[[str], str], seed: str
) -> None:
    edit = edit_package(project, seed)
    found, problem = errors(edit, execute), refusal(edit.path)
    if problem or omc.program("") or edit.kind not in LENIENT:
        assert bool(problem) is bool(found), (edit.kind, edit.path, edit.harmless, found, problem, edit.text)


@pytest.mark.skipif(not RECORDED.is_dir(), reason="the recorded answers are not there")
def test_openmodelica_refuses_what_rumoca_accepts() -> None:
    assert "Error: Modified element useAxisFlang not found in class Revolute." in (RECORDED / "stdout").read_text()
