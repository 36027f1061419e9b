"""Names that mean nothing: each is found, with what was meant, and nothing else is called missing."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import pytest
from support.plant import MARKED_PLANT, MARKED_USER, PLANT, USER, classes_in, library_classes, stored_below

from urdfsync.modelica.classes import ClassNode
from urdfsync.modelica.scopes import Scopes
from urdfsync.modelica.stored import StoredClasses
from urdfsync.modelica.unresolved import Unresolved, UnresolvedKind, unresolved


def found(*texts: str) -> list[Unresolved]:
    sources = classes_in(*texts)
    scopes = Scopes(sources)
    nodes = (scopes.node(name) for name in sources.users)
    return [one for node in nodes if isinstance(node, ClassNode) for one in unresolved(node, scopes)]


def told(body: str) -> list[str]:
    """What is found in a model of the user's that extends nothing: line, what lacks what, and what was meant."""
    text = f"model Mine\n{body}\nend Mine;\n"
    return [
        f"{one.line}: {one.owner.rpartition('.')[2]} {one.name} [{one.part}] {one.meant}".rstrip()
        for one in found(PLANT, USER, text)
    ]


def test_a_nearer_class_hides_a_package_of_the_same_name() -> None:
    text = "within Plant;\nmodel Plant\nend Plant;\n"
    user = "within Plant.Links;\nmodel Long\n  extends {}Plant.Links.Boom;\nend Long;\n"
    (hidden,) = found(PLANT, text, user.format(""))
    assert hidden.message == "here, `Plant` is Plant.Plant, which has no `Links`"
    assert hidden.meant == ".Plant.Links.Boom"
    assert found(PLANT, text, user.format(".")) == []


def test_nothing_is_said_of_what_is_right() -> None:
    assert found(PLANT, USER) == []


MISSING = {
    "redeclare": ("extends Plant.Crane(redeclare User.Telescope bom);", "2: Crane bom [bom] boom"),
    "modifier": ("Plant.Crane c(boom(numbers(mas = 3)));", "2: BoomNumbers mas [mas] mass"),
    "record": ("Plant.Crane c(boom(numbers(friction(dampin = 5))));", "2: Friction dampin [dampin] damping"),
    "line of a modifier": ("extends Plant.Test(crane(boom(\n numbs(mass = 1))));", "3: Boom numbs [numbs] numbers"),
    "connect": ("Plant.Crane c;\nPlant.Parts.Pin p;\nequation\nconnect(c.bomPin, p);",
        "5: Crane c.bomPin [bomPin] c.boomPin"),
    "no component": ("Real x = crane.boomPin.u;", "2: Mine crane.boomPin.u [crane]"),
    "type": ("Plant.Links.Bom b;", "2: Links Plant.Links.Bom [Bom] Plant.Links.Boom"),
    "import": ("import Plant.Links.Bom;", "2: Links Plant.Links.Bom [Bom] Plant.Links.Boom"),
    "type without dots": ("Nowhere n;", "2: Mine Nowhere [Nowhere]"),
    "new type": ("extends Plant.Crane(redeclare User.Telescop boom);",
        "2: User User.Telescop [Telescop] User.Telescope"),
    "function": ("Real y = Plant.Parts.twic(2);", "2: Parts Plant.Parts.twic [twic] Plant.Parts.twice"),
    "attribute": ("Real y(strat = 2);", "2: Real strat [strat] start"),
    "literal": ("Plant.Parts.Shape s = Plant.Parts.Shape.rund;",
        "2: Shape Plant.Parts.Shape.rund [rund] Plant.Parts.Shape.round"),
    "modifier of what is redeclared": ("extends Plant.Crane(redeclare User.Telescope boom(lenth = 3));",
        "2: Telescope lenth [lenth] length"),
    "value": ("Plant.Crane c(g = grav);\nparameter Real grave;", "2: Mine grav [grav] grave"),
    "in a reduction": ("parameter Real[:] num;\nReal x[size(num, 1)] = {nun[i] for i in 1:2};",
        "3: Mine nun [nun] num"),
    "range of a reduction": ("Real x = sum(k for k in nope);", "2: Mine nope [nope]"),
    "range of a loop": ("equation\nfor k in 1:nope loop\nend for;", "3: Mine nope [nope]"),
    "condition": ("Real x if nope;", "2: Mine nope [nope]"),
    "size of a type": ("Real[nope] x;", "2: Mine nope [nope]"),
    "size": ("Real x[nope];", "2: Mine nope [nope]"),
    "subscript": ("Real x[3];\nReal y = x[nope];", "3: Mine nope [nope]"),
    "from the top": ("Real Plant;\n.Plant.Crane c(gg = 1);", "3: Crane gg [gg] g"),
    "constrained package": (
        "replaceable package M = Plant.Links constrainedby Plant.Parts;\nM.Pin p;\nM.Other o;", "4: M M.Other [Other]"),
    "imported by another name": ("import Plant.Parts.{P = Pin};\nP p;\nReal y = p.v;", "4: Pin p.v [v]"),
}  # fmt: skip


@pytest.mark.parametrize(("body", "expected"), MISSING.values(), ids=MISSING)
def test_a_name_that_means_nothing_is_found(body: str, expected: str) -> None:
    assert told(body) == [expected]


UNKNOWN = {
    "unknown base": "extends Modelica.Blocks.Base;\nReal x = whatever.is.inherited;",
    "unknown type": "Modelica.Blocks.Sources.Sine sine(f = 3);\nReal y = sine.y;",
    "library that is not here": "Library.Thing thing(a = 1);\nReal y = thing.b;",
    "unknown new type": "Plant.Crane c(redeclare Modelica.Thing boom);\nReal y = c.boom.own.x;",
    "imported names": "import Plant.Parts.{twice, P = Pin};\nP p;\nReal y = twice(p.u);",
    "open package": "replaceable package M = Plant.Links;\nM.Other o;",
    "outer": "outer Plant.Crane crane;\nReal u = crane.boomPin.u + Connections.root(crane.boomPin.u);",
    "expandable connector":
        "expandable connector Bus\nend Bus;\nBus bus;\nPlant.Parts.Pin p;\nequation\nconnect(bus.any, p);",
    "element": "extends User.MyCrane;\nredeclare User.Telescope boom;\nequation\nboom.length = 1;",
    "hidden by a component": ".Plant.Crane Plant;\nReal u = Plant.boomPin.u;",
    "circle": "model B = A;\nmodel A = B;\nA a(x = 1);",
}  # fmt: skip


@pytest.mark.parametrize("body", UNKNOWN.values(), ids=UNKNOWN)
def test_nothing_is_said_of_what_cannot_be_told(body: str) -> None:
    assert told(body) == []


def test_a_class_that_extends_itself_is_told_and_nothing_of_what_it_may_have() -> None:
    assert told("extends Mine;\nReal x = y;") == ["2: Mine Mine [Mine]"]


def test_the_standard_library_is_no_misspelled_name() -> None:
    """Builds do not read it, and a package may have a name that is like it."""
    library = {
        Path(
            "/nowhere/package.mo"
        ): b"package OurModelica\n model M\n  extends Modelica.Icons.Example;\n end M;\nend OurModelica;"
    }
    sources = StoredClasses("None", Path("None"), {}, library, lambda name: None)
    scopes = Scopes(sources)
    nodes = [scopes.node(name) for name in sources.users]
    assert [one for node in nodes if isinstance(node, ClassNode) for one in unresolved(node, scopes)] == []


def test_a_redeclaration_inside_of_a_modifier_is_told_apart() -> None:
    (one,) = found(PLANT, USER, "model Mine\n extends Plant.Test(crane(redeclare User.Telescope boom));\nend Mine;\n")
    assert (one.kind, one.owner, one.name, one.line) == (UnresolvedKind.NESTED_REDECLARE, "Plant.Crane", "boom", 2)
    assert told("Plant.Crane crane(redeclare User.Telescope boom);") == []
    both = found(PLANT, USER, "model M\n Plant.Test t(crane(redeclare Nowhere boom));\nend M;")
    assert {one.kind for one in both} == {UnresolvedKind.NESTED_REDECLARE, UnresolvedKind.CLASS}


def test_a_modifier_by_a_name_with_dots_is_told_apart() -> None:
    for body in ("crane.boom.numbers.mass = 2", "crane.boom.numbers(mass = 2)"):
        (one,) = found(PLANT, USER, f"model Mine\n Plant.Test t({body});\nend Mine;\n")
        assert (one.kind, one.line) == (UnresolvedKind.DOTTED_MODIFIER, 2)
        assert one.name == body.partition("(")[0].partition(" ")[0]


@pytest.mark.parametrize("name", ["crane.boom.numbers.mas", "crane.bom.numbers.mass", "cran.boom.numbers.mass"])
def test_each_part_of_a_modifier_with_dots_is_looked_up(name: str) -> None:
    kinds = {one.kind for one in found(PLANT, USER, f"model Mine\n Plant.Test t({name} = 2);\nend Mine;\n")}
    assert UnresolvedKind.ELEMENT in kinds


def test_an_element_that_is_redeclared_is_one_of_a_base() -> None:
    text = "model Mine\n extends Plant.Crane;\n redeclare User.Telescope bom;\nend Mine;\n"
    (one,) = found(PLANT, USER, text)
    assert (one.kind, one.part, one.near, one.line) == (UnresolvedKind.ELEMENT, "bom", "boom", 3)


@pytest.mark.parametrize("text", [MARKED_PLANT, MARKED_USER], ids=["package", "user"])
def test_every_misspelled_use_is_found(text: str) -> None:
    """A name with another letter at its end is missing at this place."""
    places = [match.start() for match in re.finditer("~", text)]
    assert len(places) > 25
    for place in places:
        end = next(match.end() for match in re.finditer(r"\w+", text) if match.start() == place + 1)
        damaged = f"{text[:end]}q{text[end:]}".replace("~", "")
        line, name = text.count("\n", 0, place) + 1, f"{text[place + 1 : end]}q"
        others = (PLANT,) if text is MARKED_USER else (USER,)
        assert (line, name) in [(one.line, one.part) for one in found(damaged, *others)]


def faults_in(top: str, *inside: str) -> list[str]:
    """Names without meaning in a library, or in a package of it."""
    sources = library_classes(top)
    scopes, count, faults = Scopes(sources), 0, []
    for name in stored_below(sources, (top, *inside)):
        node = scopes.node(name)
        if isinstance(node, ClassNode):
            count += 1
            faults += [f"{node.file}:{one.line}: {one.name}" for one in unresolved(node, scopes)]
    assert count > 100
    return faults


@pytest.mark.slow
@pytest.mark.parametrize(
    "package", [("UrdfSync",), ("Modelica", "Mechanics"), pytest.param(("Modelica",), marks=pytest.mark.large)]
)
def test_nothing_is_missing_in_libraries(package: Sequence[str]) -> None:
    assert faults_in(*package) == []
