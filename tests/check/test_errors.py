"""What a compiler says of damaged packages: the cause, where it stands, and nothing twice. The texts are rumoca's."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from support import arm
from support.arm import ELBOW
from support.modelica import compile_task, execute

from urdfsync.check import errors
from urdfsync.check.compilers import omc, rumoca
from urdfsync.check.compilers.compiler import Compiler
from urdfsync.check.package import PackageFiles
from urdfsync.diagnostics import Diagnostic, Severity

COPY = "/cache/workspaces/7a/SixAxisArm"
FOLDERS = {Path(COPY): arm.DISK, Path("/cache/part/Modelica"): Path("/opt/library/Modelica 4.1.0")}
EDITED = "the file was edited by hand"
REVOLUTE = "Modelica.Mechanics.MultiBody.Joints.Revolute"
BODY = "/cache/part/Modelica/Mechanics/MultiBody/Parts/Body.mo:75:13"
SHADOW = f"variability violation: sphereDiameter has parameter variability but binding references variables [{BODY}]"


def unresolved(*complaints: str) -> str:
    """What the compiler says of names that it can't find."""
    lines = [f"- <resolve> [Resolve]: {complaint}" for complaint in complaints]
    return "\n".join(
        [f"Probe_ could not be compiled: {complaints[0]}", f"Related failures (showing {len(lines)}):", *lines]
    )


def component(name: str) -> str:
    return f"unresolved component reference: '{name}'"


def kind(name: str) -> str:
    return f"unresolved type reference: '{name}'"


def explain(
    text: str,
    edits: Mapping[str, str | bytes | None] | None = None,
    model: str = "",
    compiler: Compiler = rumoca,
) -> list[Diagnostic]:
    """The findings about the package with some edits."""
    return errors.explain(text, compiler.complaints(text), arm.package(edits), FOLDERS, model)


def explained(text: str, *more: Any, **facts: Any) -> list[str]:
    """The findings as people read them, without the folder."""
    found = explain(text, *more, **facts)
    assert all(one.severity is Severity.ERROR for one in found)
    return [str(one).removeprefix(str(arm.DISK)).removeprefix("/") for one in found]


# --- names that are not there -----------------------------------------------------------------------------------------


def test_a_top_level_package_of_another_name_is_told_where_it_is_declared() -> None:
    """What is around the robot's package is at fault: its own `package.mo` is as it should be."""
    texts = {"package.mo": b"within Plant.Robots;\npackage Arm\nend Arm;\n"}
    package = PackageFiles("Plant.Robots.Arm", Path("Plant/Robots/Arm"), texts, {"package.mo": "robot"})
    text = unresolved("unresolved import: 'Plant'", "base class not found: `Plant.Robots.Arm.Arm` does not exist")
    hint = "the class in this file has to be called so, like its folder"
    assert (
        str(errors.explain(text, rumoca.complaints(text), package, {})[0])
        == f"Plant/package.mo: error: there is no package `Plant`; {hint} [unresolved]"
    )


BASE = "UrdfSync.Interfaces.PartialRevoluteJoint"
WRONG_BASE = BASE.replace("Revolute", "Revolut")
TURRET = "Joints/Turret.mo"
LOAD = '\n  // load.tau\n  Real load(start = 0) "load.tau";\nequation\n  load[1].tau = 0;'


@pytest.mark.parametrize(
    ("text", "edits", "expected"),
    [
        pytest.param(
            unresolved(component("orgin.frame_a")),
            arm.changed("connect(frame_a, origin.frame_a)", "connect(frame_a, orgin.frame_a)"),
            f"{ELBOW}:{arm.line('connect(frame_a, origin')}: error: joint elbow: `orgin.frame_a` is not declared; "
            f"{EDITED} [unresolved]",
            id="a component",
        ),
        pytest.param(
            unresolved(*map(component, ("revolute.phi", "revolute.w")), kind(REVOLUTE[:-1])),
            arm.changed(REVOLUTE, REVOLUTE[:-1]),
            f"{ELBOW}:{arm.line(f'{REVOLUTE} revolute')}: error: joint elbow: there is no class `{REVOLUTE[:-1]}`; "
            f"{EDITED} [unresolved]",
            id="a class, without what follows from it",
        ),
        pytest.param(
            unresolved(
                f"base class not found: `{WRONG_BASE}` does not exist",
                component("frame_a"),
                f"unresolved extends base class: '{WRONG_BASE}'",
            ),
            arm.changed(BASE, WRONG_BASE),
            f"{ELBOW}:{arm.line(BASE)}: error: joint elbow: there is no class `{WRONG_BASE}`; {EDITED} [unresolved]",
            id="a base class",
        ),
        pytest.param(
            unresolved(component("revolute.phi")),
            {TURRET: arm.text(TURRET) + "\n"},
            f"{TURRET}:{arm.line('revolute.phi', TURRET)}: error: `revolute.phi` is not declared; {EDITED} "
            "[unresolved]",
            id="in the file that was edited",
        ),
        pytest.param(
            unresolved(component("load.tau")),
            arm.changed("\nequation", LOAD),
            f"{ELBOW}:{arm.line('equation') + 3}: error: joint elbow: `load.tau` is not declared; {EDITED} "
            "[unresolved]",
            id="not in a string, nor in a comment",
        ),
        pytest.param(
            unresolved(component("tank.level")),
            {ELBOW: arm.text() + "\n"},
            ": error: `tank.level` is not declared; nothing in the package mentions it: a library does, or a file "
            "around the package [unresolved]",
            id="nobody mentions it",
        ),
        pytest.param(
            unresolved(component("Modelica.Math.foo"), "unresolved function call: 'Modelica.Math.foo'"),
            arm.changed("\nequation", "\n  parameter Real z = Modelica.Math.foo(1);\nequation"),
            f"{ELBOW}:{arm.line('equation')}: error: joint elbow: there is no function `Modelica.Math.foo`; {EDITED} "
            "[unresolved]",
            id="a function",
        ),
        pytest.param(
            unresolved(f"base class not found: `{arm.NAME}.SixAxisArm` does not exist"),
            {"SixAxisArm.mo": None},
            f"SixAxisArm.mo: error: robot: there is no class `{arm.NAME}.SixAxisArm`; it has to be declared there "
            "[unresolved]",
            id="the robot itself",
        ),
        pytest.param(
            f"Failed to load source root '{COPY}': parse source-root files under {COPY}",
            None,
            f": error: parse source-root files under {arm.DISK} [does-not-compile]",
            id="a folder",
        ),
        pytest.param(
            f"typecheck failed: Probe_ failed in Typecheck: {SHADOW}; {SHADOW}; missing source context",
            None,
            ": error: missing source context [does-not-compile]",
            id="beside shadows",
        ),
    ],
)
def test_the_cause_is_told_where_it_stands(text: str, edits: Mapping[str, str | None] | None, expected: str) -> None:
    assert explained(text, edits) == [expected]


# --- equations and unknowns -------------------------------------------------------------------------------------------

COUNTS = "unknowns[state=148 algebraic=6037 output=0] equations[continuous=6186 discrete_real=0]"


def unbalanced(equations: int, unknowns: int) -> str:
    """What the compiler says of a model that has not as many equations as unknowns."""
    balance = equations - unknowns
    words = f"unbalanced model: {equations} equations, {unknowns} unknowns (balance = {balance}); {COUNTS}"
    return f"todae failed: Probe_ failed in ToDae: {words}"


EXTRA = arm.changed("\nequation", "\n  Real z;\nequation")


def test_an_unbalanced_model_is_named_and_looked_for_in_the_edited_file() -> None:
    """The joint need not be what lacks an equation."""
    message = "there is 1 equation too many"
    assert explained(unbalanced(6354, 6353), EXTRA, model="SixAxisArm") == [
        f"{ELBOW}: error: {message}; look here first: {EDITED} [unbalanced]"
    ]
    (found,) = explained(unbalanced(1, 4), EXTRA)
    assert "error: there are 3 equations too few" in found


def test_the_same_fault_in_other_models_has_the_same_words() -> None:
    """The benches have other equations as well, and lack as many: a result has each finding once."""
    first, second = (explain(unbalanced(number, number + 1), EXTRA, model="SixAxisArm") for number in (1824, 1854))
    assert first == second
    assert first != explain(unbalanced(1853, 1855), EXTRA, model="SixAxisArm")


def test_a_class_of_the_users_is_unbalanced_in_its_own_file() -> None:
    edits = {**EXTRA, "Tools/Own.mo": "model Own\n  Real z;\nend Own;\n"}
    hint = f"look at {arm.DISK}/{ELBOW}, which was edited"
    assert explained(unbalanced(0, 1), edits, model="Tools.Own") == [
        f"Tools/Own.mo: error: there is 1 equation too few; {hint} [unbalanced]"
    ]


# --- complaints with a place ------------------------------------------------------------------------------------------


def test_a_complaint_about_the_package_outweighs_its_shadows() -> None:
    real = f"unknown modifier `foo` for component `origin` [{COPY}/{ELBOW}:45:11]"
    text = "typecheck failed: Probe_ failed in Typecheck: " + "; ".join([SHADOW] * 12 + [real] + [SHADOW] * 7)
    message = f"joint elbow: unknown modifier `foo` for component `origin`; {EDITED}"
    assert explained(text, {ELBOW: arm.text() + "\n"}) == [f"{ELBOW}:45:11: error: {message} [does-not-compile]"]


def test_a_shadow_alone_is_passed_on_with_the_folder_that_people_know() -> None:
    (found,) = explain(f"typecheck failed: Probe_ failed in Typecheck: {SHADOW}; {SHADOW}")
    assert found.message.startswith("variability violation: sphereDiameter")
    assert (found.file, found.line) == ("/opt/library/Modelica 4.1.0/Mechanics/MultiBody/Parts/Body.mo", 75)


def test_folders_of_copies_are_never_shown() -> None:
    text = f"instantiate failed: Probe_ failed in Instantiate: can't read '{COPY}/Links' nor {COPY}/{ELBOW}, sorry"
    (found,) = explained(text)
    assert f"can't read '{arm.DISK}/Links' nor {arm.DISK}/Joints/Elbow.mo, sorry" in found


FRAMED = f"""\
EP001

  × `not` is a reserved keyword in Modelica (MLS §2.3.3) and cannot be used as
  │ an identifier
    ╭─[{COPY}/{ELBOW}:68:10]
 67 │ equatoin
 68 │   assert(not checkLimits or revolute.phi >= parameters.limits.lower - 1e-6,
    ·          ─┬─
    ·           ╰── unexpected `not`
    ╰────
  help: expected one of: each, final, redeclare, replaceable, )
"""


def test_a_complaint_with_a_frame_becomes_one_line() -> None:
    words = "`not` is a reserved keyword in Modelica (MLS §2.3.3) and cannot be used as an identifier"
    assert explained(FRAMED) == [f"{ELBOW}:68:10: error: joint elbow: {words} [does-not-compile]"]
    assert len(explained("\x1b[31m" + FRAMED + FRAMED.replace(":68:", ":70:"))) == 2


def test_messages_of_openmodelica_have_their_places() -> None:
    text = (
        f"[{COPY}/package.mo:3:1-9:2:writable] Warning: Requested package Modelica of version 4.0.0.\n"
        f"[{COPY}/{ELBOW}:68:3-68:35:writable] Error: Variable orgin.frame_a not found in scope {arm.NAME}.\n"
        "[/opt/library/Modelica 4.1.0/package.mo:1:1-2:2:readonly] Notification: From here:\n"
        "Error: Error occurred while flattening model Probe_\n"
    )
    message = f"joint elbow: Variable orgin.frame_a not found in scope {arm.NAME} [does-not-compile]"
    assert explained(text, compiler=omc) == [f"{ELBOW}:68:3: error: {message}"]


def test_five_complaints_are_enough() -> None:
    text = "; ".join(f"subscript {n} is out of bounds [{COPY}/{ELBOW}:{n}:1]" for n in range(1, 10))
    found = explained(text)
    assert len(found) == 5
    assert found[-1].endswith("; there are 4 more [does-not-compile]")


# --- files that can't be loaded ---------------------------------------------------------------------------------------


def test_rules_of_the_layout_have_their_files() -> None:
    rules = (
        f"Failed to load source root '{COPY}': invalid Modelica package layout under '{COPY}': "
        f"PKG-010 file '{COPY}/{ELBOW}' has `within A;` but expected `within B;`; "
        f"PKG-006 directory '{COPY}/Links' is missing package.mo"
    )
    assert explained(rules) == [
        f"{ELBOW}: error: joint elbow: the file has `within A;` but expected `within B;` [layout]",
        "Links: error: the directory is missing package.mo [layout]",
    ]


# --- whatever else it says --------------------------------------------------------------------------------------------


@example(":")
@given(st.text(st.sampled_from("ab:;'`[]()×╭─\n 12{}.") | st.characters(codec="utf-8"), min_size=1))
def test_any_text_gives_something(text: str) -> None:
    found = explain(text)
    assert bool(found) == bool(text.strip())
    assert all("\n" not in str(one) for one in found)


BENCH = """\
within {0};
model Bench
  inner Modelica.Mechanics.MultiBody.World world;
  Joints.Elbow elbow;
  Modelica.Mechanics.MultiBody.Parts.Body load(m = 1, r_CM = {{0, 0, 0}});
equation
  connect(world.frame_b, elbow.frame_a);
  connect(elbow.frame_b, load.frame_a);
end Bench;
"""
DAMAGES = {
    "unresolved": arm.changed(REVOLUTE, REVOLUTE[:-1]),
    "unbalanced": arm.changed("\nequation", "\n  Real z;\nequation"),
    "does-not-compile": arm.changed("\nequation", "\n  Real z = sin(1, 2);\nequation"),
}


@pytest.mark.slow
def test_the_compiler_still_speaks_as_these_texts_do(modelica_library: Path, tmp_path: Path) -> None:
    roots, tasks = [], []
    for number, edits in enumerate(DAMAGES.values()):
        name = f"Elbows{number}"
        texts = {
            path: edits.get(path, arm.text(path)) for path in (ELBOW, "Joints/ElbowParameters.mo", "Joints/package.mo")
        }
        texts = {path: text.replace(f"within {arm.NAME}", f"within {name}") for path, text in texts.items()}
        for path, text in {
            **texts,
            "Bench.mo": BENCH.format(name),
            "package.mo": f"package {name}\nend {name};\n",
        }.items():
            (tmp_path / name / path).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / name / path).write_text(text)
        roots.append(tmp_path / name)
        tasks.append(compile_task(f"{name}.Bench"))
    for code, root, outcome in zip(DAMAGES, roots, execute(modelica_library, roots, tasks), strict=True):
        package = arm.package(DAMAGES[code], name=root.name)
        (found,) = errors.explain(outcome.error, rumoca.complaints(outcome.error), package, {root: arm.DISK})
        assert (found.code, found.file) == (code, f"{arm.DISK}/{ELBOW}")
