"""The meaning of names: the types that a component may have, the names that a class knows, and what a library holds."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from support.plant import PLANT, USER, classes_in, library_classes, stored_below

from urdfsync.modelica.classes import ClassNode, Type
from urdfsync.modelica.scopes import ANYTHING, INTERFACES, Missing, NamedElement, Scopes
from urdfsync.modelica.stored import StoredClasses
from urdfsync.modelica.syntax import Name


def test_what_a_name_means() -> None:
    scopes = Scopes(classes_in(PLANT, USER))
    mine = scopes.node(("User", "MyTest"))
    assert isinstance(mine, ClassNode)
    boom = scopes.lookup(Name(("crane", "boom"), 1), mine)
    assert isinstance(boom, NamedElement)
    assert {str(one) for one in boom.types} == {"Plant.Links.Boom", "Plant.Parts.PartialPart", "User.Telescope"}
    assert isinstance(scopes.lookup(Name(("crane", "boom", "width"), 1), mine), Missing)
    assert scopes.lookup(Name(("Modelica", "Constants", "pi"), 1), mine) is ANYTHING


@pytest.mark.slow
def test_every_use_in_a_generated_package_can_be_told() -> None:
    """Each name in its equations means something, and nothing once it is misspelled: no lookup ends in the unknown."""
    sources = library_classes("Modelica")
    scopes, count, faults = Scopes(sources), 0, []
    for stored in stored_below(sources, ("UrdfSync", "Examples", "SixAxisArm")):
        node = scopes.node(stored)
        assert isinstance(node, ClassNode)
        for name in {one for one in node.definition.uses if not one.is_called and one.parts != ("time",)}:
            faults += [f"{name} is missing in {stored}"] if isinstance(scopes.lookup(name, node), Missing) else []
            for index, part in enumerate(name.parts):
                parts = (*name.parts[:index], f"{part}q", *name.parts[index + 1 :])
                if isinstance(scopes.lookup(name._replace(parts=parts), node), NamedElement):
                    faults.append(f"{'.'.join(parts)} has a meaning in {stored}")
                count += 1
    assert faults == []
    assert count > 500


def test_what_is_known_of_the_standard_library_is_what_is_in_it(modelica_library: Path) -> None:
    top = next(path for path in modelica_library.iterdir() if re.fullmatch(r"Modelica( [\d.]+)?", path.name))
    places = {"Modelica": top}
    scopes = Scopes(StoredClasses("None", Path("None"), {}, {}, places.get))
    for name, known in INTERFACES.items():
        node = scopes.node(name)
        assert node is not None, name
        names = {one for one, is_class in scopes.names_in((Type(node),)).items() if not is_class}
        assert names == known.components.keys(), name


def meaning(body: str, name: str, start: str = "model") -> list[str] | None:
    """The types that a name may have in the user's model `Own.Mine` with this body; None if it is missing."""
    text = f"package Own\n {start} Mine\n{body}\n end Mine;\n model Other\n end Other;\nend Own;\n"
    scopes = Scopes(classes_in(PLANT, USER, text))
    found = scopes.lookup(
        Name(tuple(name.strip(".").split(".")), 1, is_global=name[:1] == "."), scopes.node(("Own", "Mine"))
    )
    return sorted(map(str, found.types)) if isinstance(found, NamedElement) else None


BOOM = "Plant.Links.Boom"
MEANINGS: dict[str, tuple[str, str, list[str] | None]] = {
    "component": ("Plant.Crane c;", "c.boom", [BOOM, "Plant.Parts.PartialPart"]),
    "inherited": ("extends Plant.Links.Boom;", "numbers.mass", ["Real"]),
    "redeclared": ("extends Plant.Crane(redeclare User.Telescope boom);", "boom",
        [BOOM, "Plant.Parts.PartialPart", "User.Telescope"]),
    "redeclared as an element": ("extends Plant.Crane;\nredeclare User.Telescope boom;", "boom",
        [BOOM, "Plant.Parts.PartialPart", "User.Telescope"]),
    "class around": ("", "Other", ["Own.Other"]),
    "imported": ("import B = Plant.Links.Boom;", "B", [BOOM]),
    "everything imported": ("import Plant.Links.*;", "Boom", [BOOM]),
    "own before imported": ("import Plant.Links.*;\nmodel Boom\nend Boom;", "Boom", ["Own.Mine.Boom"]),
    "inherited class that goes on": (
        "extends A;\nmodel A\n model M\n  Real x;\n end M;\nend A;\nmodel extends M\n Real y;\nend M;", "M.x",
        ["Real"]),
    "from the top": ("Real Plant;", ".Plant.Crane", ["Plant.Crane"]),
    "literal": ("", "Plant.Parts.Shape.flat", ["Plant.Parts.Shape"]),
    "attribute of an enumeration": ("Plant.Parts.Shape s;", "s.start", [""]),
    "missing part": ("Plant.Crane c;", "c.bom", None),
    "nothing": ("", "nowhere", None),
}  # fmt: skip


@pytest.mark.parametrize(("body", "name", "types"), MEANINGS.values(), ids=MEANINGS)
def test_types_are_those_of_the_language(body: str, name: str, types: list[str] | None) -> None:
    assert meaning(body, name) == types


def test_an_encapsulated_class_sees_nothing_around_it() -> None:
    assert meaning("", "Other", "encapsulated model") is None
    assert meaning("", "Plant.Links.Boom", "encapsulated model") == [BOOM]


def test_where_one_of_two_types_is_unknown_the_other_does_not_decide() -> None:
    """A class extends one that is not at hand: what it lacks may be in there."""
    body = "model A\nend A;\nmodel B\n extends Modelica.Base;\nend B;\nmodel C\n Real x;\nend C;\n{0}"
    assert meaning(body.format("replaceable C c constrainedby A;"), "c.x") == ["Real"]
    assert meaning(body.format("replaceable C c constrainedby B;"), "c.x") == ["", "Real"]


def test_names_that_are_offered() -> None:
    text = "package Own\n model Mine\n  import Plant.Links.*;\n  import F = Plant.Parts.Friction;\n"
    scopes = Scopes(classes_in(PLANT, USER, f"{text}  extends Plant.Crane;\n end Mine;\nend Own;\n"))
    mine, plant = scopes.node(("Own", "Mine")), scopes.node(("Plant",))
    assert mine is not None
    assert plant is not None
    assert scopes.names_in((Type(mine),)) == {"g": False, "boomPin": False, "boom": False}
    tops, classes = dict.fromkeys(("Plant", "User", "Own"), True), dict.fromkeys(("Boom", "F", "Mine"), True)
    boom_numbers = {"BoomNumbers": True}
    assert scopes.names_around(mine) == {**tops, **classes, **boom_numbers, **scopes.names_in((Type(mine),))}
    assert scopes.names_in((Type(plant),)).keys() == {"Parts", "Links", "Crane", "Test"}


def test_classes_of_a_package_in_files_are_offered_and_broken_ones_are_unknown() -> None:
    texts = {"package.mo": b"package Arm\n model A\n end A;\nend Arm;\n", "B.mo": b"within Arm;\nmodel B\n Real = 3;"}
    scopes = Scopes(StoredClasses("Arm", Path("/p/Arm"), texts, {}, lambda _: None))
    arm = scopes.node(("Arm",))
    assert arm is not None
    assert scopes.names_in((Type(arm),)) == {"A": True, "B": True}
    assert scopes.node(("Arm", "B")) is None
    assert scopes.lookup(Name(("B", "x"), 1), arm) is ANYTHING
