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

from urdfsync.analysis.checks.compilation import explain as explain_problem
from urdfsync.analysis.checks.compilers import omc, rumoca
from urdfsync.analysis.checks.compilers.compiler import Compiler
from urdfsync.common.diagnostics import Diagnostic, Severity

EDITED = "the file was edited by hand"
BODY = "/opt/Modelica 4.1.0/Mechanics/MultiBody/Parts/Body.mo:75:13"
SHADOW = f"variability violation: sphereDiameter has parameter variability but binding references variables [{BODY}]"


def explain(
    text: str, edits: Mapping[str, str | bytes | None] | None = None, users: str = "", compiler: Compiler = rumoca
) -> list[Diagnostic]:
    """The findings about the package with some edits, or about a file of the user's in it."""
    return explain_problem(text, compiler, arm.package(edits), arm.DISK / users if users else None)


def explained(text: str, *more: Any, **facts: Any) -> list[str]:
    """The findings as people read them, without the folder."""
    found = explain(text, *more, **facts)
    assert all(one.severity is Severity.ERROR for one in found)
    return [str(one).removeprefix(str(arm.DISK)).removeprefix("/") for one in found]


# --- equations and unknowns -------------------------------------------------------------------------------------------

COUNTS = "unknowns[state=148 algebraic=6037 output=0] equations[continuous=6186 discrete_real=0]"


def unbalanced(equations: int, unknowns: int) -> str:
    """What the compiler says of a model that has not as many equations as unknowns."""
    balance = equations - unknowns
    words = f"unbalanced model: {equations} equations, {unknowns} unknowns (balance = {balance}); {COUNTS}"
    return f"todae failed: Probe_ failed in ToDae: {words}"


EXTRA = arm.changed("\nequation", "\n  Real z;\nequation")


LOOK = f"look at {arm.DISK}/{ELBOW}, which was edited"


def test_an_unbalanced_model_is_looked_for_in_the_edited_file() -> None:
    """The joint need not be what lacks an equation."""
    assert explained(unbalanced(6354, 6353), EXTRA) == [
        f"{ELBOW}: error: there is 1 equation too many; {LOOK} [unbalanced]"
    ]
    (found,) = explained(unbalanced(1, 4), EXTRA)
    assert "error: there are 3 equations too few" in found


def test_the_same_fault_in_other_models_has_the_same_words() -> None:
    """The benches have other equations as well, and lack as many: a result has each finding once."""
    first, second = (explain(unbalanced(number, number + 1), EXTRA) for number in (1824, 1854))
    assert first == second
    assert first != explain(unbalanced(1853, 1855), EXTRA)


def test_a_class_of_the_users_is_unbalanced_in_its_own_file() -> None:
    edits = {**EXTRA, "Tools/Own.mo": "model Own\n  Real z;\nend Own;\n"}
    assert explained(unbalanced(0, 1), edits, users="Tools/Own.mo") == [
        f"Tools/Own.mo: error: there is 1 equation too few; {LOOK} [unbalanced]"
    ]


def test_a_complaint_without_a_place_about_a_class_of_the_users_is_in_its_own_file() -> None:
    """With a package that waits for conflicts, the folder said nothing."""
    edits = {"Tools/Own.mo": "model Own\n  Real z;\nend Own;\n"}
    (found,) = explained("flatten failed: every component needs a root (MLS §9.4)", edits, users="Tools/Own.mo")
    assert found.startswith("Tools/Own.mo: error: every component needs a root")


# --- complaints with a place ------------------------------------------------------------------------------------------


def test_a_complaint_about_the_package_outweighs_its_shadows() -> None:
    real = f"unknown modifier `foo` for component `origin` [{arm.DISK}/{ELBOW}:45:11]"
    text = "typecheck failed: Probe_ failed in Typecheck: " + "; ".join([SHADOW] * 12 + [real] + [SHADOW] * 7)
    message = f"joint elbow: unknown modifier `foo` for component `origin`; {EDITED}"
    assert explained(text, {ELBOW: arm.text() + "\n"}) == [f"{ELBOW}:45:11: error: {message} [does-not-compile]"]


def test_a_shadow_alone_is_passed_on() -> None:
    (found,) = explain(f"typecheck failed: Probe_ failed in Typecheck: {SHADOW}; {SHADOW}")
    assert found.message.startswith("variability violation: sphereDiameter")
    assert (found.file, found.line) == ("/opt/Modelica 4.1.0/Mechanics/MultiBody/Parts/Body.mo", 75)


def test_a_shadow_beside_a_fault_of_a_library_is_left_out() -> None:
    (found,) = explain(f"typecheck failed: Probe_ failed in Typecheck: {SHADOW}; `x` is unknown [/opt/Pumps.mo:3:1]")
    assert (found.file, found.line) == ("/opt/Pumps.mo", 3)


FRAMED = f"""\
EP001

  × `not` is a reserved keyword in Modelica (MLS §2.3.3) and cannot be used as
  │ an identifier
    ╭─[{arm.DISK}/{ELBOW}:68:10]
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
        f"[{arm.DISK}/package.mo:3:1-9:2:writable] Warning: Requested package Modelica of version 4.0.0.\n"
        f"[{arm.DISK}/{ELBOW}:68:3-68:35:writable] Error: Variable orgin.frame_a not found in scope {arm.NAME}.\n"
        "[/opt/library/Modelica 4.1.0/package.mo:1:1-2:2:readonly] Notification: From here:\n"
        "Error: Error occurred while flattening model Probe_\n"
    )
    message = f"joint elbow: Variable orgin.frame_a not found in scope {arm.NAME} [does-not-compile]"
    assert explained(text, compiler=omc) == [f"{ELBOW}:68:3: error: {message}"]


def test_five_complaints_are_enough() -> None:
    text = "; ".join(f"subscript {n} is out of bounds [{arm.DISK}/{ELBOW}:{n}:1]" for n in range(1, 10))
    found = explained(text)
    assert len(found) == 5


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
        said = outcome.error.replace(str(root), str(arm.DISK))
        (found,) = explain_problem(said, rumoca, package)
        assert (found.code, found.file) == (code, f"{arm.DISK}/{ELBOW}")
