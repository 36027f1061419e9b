"""Other values of parameters: what is read, and the modifiers that say it."""

from __future__ import annotations

import pytest

from urdfsync.analysis.simulation.values import modifiers, nearest_parameter, read_values
from urdfsync.common.diagnostics import ConfigError


def test_names_become_nested_modifiers() -> None:
    given = ["robot.elbow.parameters.axis={0, -1, 0}", "robot.elbow.parameters.dynamics.damping = 4", "k=1e-3"]
    assert modifiers(read_values(given)) == [
        "robot(elbow(parameters(axis = {0, -1, 0}, dynamics(damping = 4))))",
        "k = 1e-3",
    ]


@pytest.mark.parametrize(
    "value", ["4", "-4.5e-3", "true", '"steel"', "{1, 2}", "{{1,0},{0,1}}", "{-1., .5}", r'{"a\"}", "//"}']
)
def test_literals_are_values(value: str) -> None:
    assert read_values([f"a={value}"]) == {"a": value}


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (["a"], "gives no value"),
        (["a="], "is no value"),
        (["a=b"], "`b` is no value for `a`"),
        (["a=1)); end Probe_; model X(b=(1"], "is no value"),
        (['a="'], "is no value"),
        (["a={1"], "is no value"),
        (["a=}{"], "is no value"),
        (["a={}"], "is no value"),
        (["a={1,,2}"], "is no value"),
        (["a=1 2"], "is no value"),
        (["a=- -"], "is no value"),
        (["a=1.2.3"], "is no value"),
        (["a=1e999"], "`1e999` is no value for `a`"),
        (["a=1 // about"], "is no value"),
        (["a=1 /* about */"], "is no value"),
        (["a[1]=1"], "give the whole vector"),
        (["a..b=1"], "can't be a parameter"),
        (["a=1", "a=2"], "gets two values"),
    ],
)
def test_what_is_no_value_is_refused(given: list[str], words: str) -> None:
    with pytest.raises(ConfigError) as caught:
        read_values(given)
    assert words in str(caught.value)


@pytest.mark.parametrize("given", [["a=1", "a.b=2"], ["a.b=2", "a=1"], ["a.b=1", "a.b.c.d=2"]])
def test_a_part_and_the_whole_contradict_each_other(given: list[str]) -> None:
    with pytest.raises(ConfigError, match="the whole around it"):
        modifiers(read_values(given))


DAMPING = "robot.elbow.parameters.dynamics.damping"


@pytest.mark.parametrize(("name", "meant"), [
    ("robot.elbow.parameters.dynamics.dampin", DAMPING),
    ("elbow.damping", DAMPING),
    ("elbo.dampin", DAMPING),
    ("wrist.damping", "robot.wrist.parameters.dynamics.damping"),
    ("damping", DAMPING),
    ("robot.checkLimit", "robot.checkLimits"),
    ("robot.elbow.colour", ""),
    ("", ""),
])  # fmt: skip
def test_the_parameter_that_was_meant_is_found_also_where_parts_of_its_name_are_missing(name: str, meant: str) -> None:
    known = [DAMPING, "robot.checkLimits", DAMPING.replace("elbow", "wrist"), "robot.elbow.friction.steepness"]
    assert nearest_parameter(name, known) == meant
    assert nearest_parameter(name, []) == ""
