"""The model that is simulated: what its annotation says, its inputs, and how these follow a table."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync.analysis.simulation.models import Input, Model, find_model
from urdfsync.common.diagnostics import ConfigError
from urdfsync.modelica.scopes import Scopes
from urdfsync.modelica.stored import StoredClasses

RUN = """within Plant;
model Run "Two inputs, and drives"
  extends Base;
  Modelica.Blocks.Interfaces.RealInput elbow_phi(unit = "rad") "Where it is to go"
    annotation (Placement(transformation(extent={{-1, -1}, {1, 1}})));
  Modelica.Mechanics.Rotational.Sources.Position elbowDrive(useSupport = true, exact = false);
  Modelica.Mechanics.Translational.Sources.Speed slides[2](each exact = false);
  Modelica.Mechanics.Rotational.Sources.Torque wristDrive;
  annotation (experiment(StopTime=2.5, Interval=1e-2, Tolerance=1e-6));
end Run;
"""
BASE = """within Plant;
partial model Base
  Modelica.Blocks.Interfaces.RealInput commands[2](unit = {"m", "N"}), free;
  annotation (experiment(StopTime = 99));
end Base;
"""


def model(text: str = RUN, base: str = BASE) -> Model:
    texts = {"package.mo": b"package Plant\nend Plant;\n", "Run.mo": text.encode(), "Base.mo": base.encode()}
    sources = StoredClasses("Plant", Path("/p/Plant"), texts, {}, lambda _: None)
    return find_model(Scopes(sources), "Plant", "Run", sources.content)


@pytest.mark.parametrize(
    ("said", "expected"),
    [
        ("StopTime=2.5, Interval=1e-2", {"StopTime": 2.5, "Interval": 0.01}),
        ("StartTime = 0, StopTime = 5 , NumberOfIntervals = 100", {"StopTime": 5.0, "NumberOfIntervals": 100.0}),
        ('__Tool_Settings(method = "x"), StopTime = 5', {"StopTime": 5.0}),
        ("StopTime = 2*3600, Tolerance=1e-6", {"Tolerance": 1e-6}),
        ("", {}),
    ],
)
def test_settings_are_those_of_the_model_itself(said: str, expected: dict[str, float]) -> None:
    assert model(RUN.replace("StopTime=2.5, Interval=1e-2, Tolerance=1e-6", said)).settings == expected


def test_inputs_have_names_and_units_those_of_base_classes_first() -> None:
    assert model().inputs() == [
        Input("commands[1]", "m"),
        Input("commands[2]", "N"),
        Input("free", ""),
        Input("elbow_phi", "rad"),
    ]
    assert model(base=BASE.replace('unit = {"m", "N"}', 'each unit = "m"')).inputs()[:2] == [
        Input("commands[1]", "m"),
        Input("commands[2]", "m"),
    ]
    several = BASE.replace(", free;", ', free "a; b, c", turn(min = f(1, 2), unit = "rad");')
    assert model(base=several).inputs()[2:4] == [Input("free", ""), Input("turn", "rad")], "each has its own unit"


@pytest.mark.parametrize(
    "input_",
    [
        "input Real u",
        "Modelica.Blocks.Interfaces.RealInput u[n]",
        "Modelica.Blocks.Interfaces.RealInput[2] u",
        "Modelica.Blocks.Interfaces.RealVectorInput u[2]",
        "Modelica.Blocks.Interfaces.BooleanInput u",
    ],
)
def test_inputs_that_no_table_can_drive_are_refused_with_their_line(input_: str) -> None:
    with pytest.raises(ConfigError, match="the input `u` can't be driven") as caught:
        model(RUN.replace("  extends Base;", f"  {input_};")).inputs()
    assert caught.value.diagnostics[0].line == 3


def test_a_conditional_input_that_no_table_can_drive_is_taken_for_absent() -> None:
    text = RUN.replace("  extends Base;", "  Modelica.Blocks.Interfaces.BooleanInput u if false;")
    assert [one.name for one in model(text).inputs()] == ["elbow_phi"]


def test_inputs_become_outputs_where_they_are_declared_and_nothing_else_changes() -> None:
    driven = model().driven("Plant")
    assert driven.changed == {
        Path("/p/Plant/Run.mo"): RUN.replace("RealInput", "RealOutput").encode(),
        Path("/p/Plant/Base.mo"): BASE.replace("RealInput", "RealOutput").encode(),
    }
    assert driven.modifiers == ("elbowDrive(exact = true)", "slides(each exact = true)")
    assert model().driven("Plant.Arm").modifiers == (), "a model of the user's"


@pytest.mark.parametrize(("begin", "end"), [("\ufeff", "\n"), ("", "\r\n")])
def test_a_byte_order_mark_and_other_line_ends_move_nothing(begin: str, end: str) -> None:
    """Components say where they begin in the text as it is parsed."""
    same = model(begin + RUN.replace("\n", end), begin + BASE.replace("\n", end))
    assert (same.settings, same.inputs()) == (model().settings, model().inputs())
    changed = same.driven("Plant").changed[Path("/p/Plant/Run.mo")].decode()
    assert changed == begin + RUN.replace("RealInput", "RealOutput")
