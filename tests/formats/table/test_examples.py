"""The examples of docs/tables.md: what their models compute equals what other programs do."""

from __future__ import annotations

import csv
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm
from support.commands import Execute
from support.modelica import Run, compile_task, simulate
from support.networks import edit

from urdfsync.analysis.checks.compilers import omc

pytestmark = pytest.mark.slow
EXAMPLES = Path(__file__).parent / "examples"
TOOLS = [
    "rumoca",
    pytest.param("omc", marks=pytest.mark.skipif(omc.program("") is None, reason="no OpenModelica")),
]


@pytest.fixture
def build(folder: Path, execute: Execute, modelica_library: Path) -> Callable[[str], None]:
    def run(name: str) -> None:
        shutil.copytree(EXAMPLES / name, folder, dirs_exist_ok=True)
        execute("build")

    return run


def result(library: Path, model: str, values: list[str], run: Run, tool: str) -> dict[str, float]:
    """The values at the end of a run."""
    package = model.partition(".")[0]
    task = compile_task(model, runs=(run,), values=values)
    (series,) = simulate(library, [Path("modelica", package).absolute()], [task], tool=tool)
    return {name: float(series.values[name][-1]) for name in values}


@pytest.mark.parametrize("tool", TOOLS)
def test_the_temperatures_of_a_house_equal_those_of_a_matrix_exponential(
    build: Callable[[str], None], execute: Execute, modelica_library: Path, tool: str
) -> None:
    build("thermal")
    rows = {row["name"]: row for row in csv.DictReader(Path("house.csv").read_text().splitlines())}
    links = list(csv.DictReader(Path("house.connections.csv").read_text().splitlines()))
    rooms = [name for name, row in rows.items() if row["kind"] == "room"]
    rates, constant = np.zeros((3, 3)), np.zeros(3)
    for wall in (name for name, row in rows.items() if row["kind"] == "wall"):
        sides = [link["to"] for link in links if link["from"] == wall]
        for here, there in (sides, sides[::-1]):
            if here in rooms:
                conductance = float(rows[wall]["conductance [W/K]"])
                rates[rooms.index(here), rooms.index(here)] -= conductance
                if there in rooms:
                    rates[rooms.index(here), rooms.index(there)] += conductance
                else:
                    constant[rooms.index(here)] += conductance * (float(rows[there]["temperature [degC]"]) + 273.15)
    constant[rooms.index("living room")] += float(rows["heater"]["power [W]"])
    capacities = np.array([1000 * float(rows[name]["capacity [kJ/K]"]) for name in rooms])
    rates, constant = rates / capacities[:, None], constant / capacities
    start = np.array([float(rows[name]["temperature [degC]"]) + 273.15 for name in rooms])
    steady = -np.linalg.solve(rates, constant)
    expected = steady + expm(rates * 36000) @ (start - steady)

    names = ["living_room.air.T", "bedroom.air.T", "attic.air.T"]
    found = result(modelica_library, "House.House", names, Run(36000, 3600, tolerance=1e-9), tool)
    assert [found[name] for name in names] == pytest.approx(list(expected), rel=1e-6)

    edit(Path("house.csv"), "outer wall,wall,,35", "outer wall,wall,,37")
    assert "update     modelica/House/Records/Outer_wall.mo" in execute("diff", code=1).out
    assert "1 file written" in execute("build").out


@pytest.mark.large  # both readings know a catalogue, see test_catalogue
def test_a_robot_with_motors_of_a_catalogue_is_right(build: Callable[[str], None], execute: Execute) -> None:
    build("servos")
    found = execute("check", "--physics", "--tool", "rumoca").words
    assert "arm: right: numbers right (132 of 132); 3 models compile; 3 degrees of freedom" in found
    assert "servos: right" in found


def pressures(file: Path) -> dict[str, float]:
    """The pressures that EPANET finds at the beginning, by the junctions' names."""
    wntr: Any = pytest.importorskip("wntr", reason="wntr is not installed")
    network = wntr.network.WaterNetworkModel(str(file))
    network.options.time.duration, network.options.hydraulic.accuracy = 0, 1e-8
    found = wntr.sim.EpanetSimulator(network).run_sim(file_prefix="epanet").node["pressure"].iloc[0]
    return {name: float(found[name]) for name in network.junction_name_list}


@pytest.mark.parametrize("tool", TOOLS)
@pytest.mark.parametrize("source", ["town.inp", "Net1.inp"])
def test_the_pressures_of_water_networks_equal_those_of_epanet(
    build: Callable[[str], None], execute: Execute, modelica_library: Path, source: str, tool: str
) -> None:
    """One network is ours, the other one of those that wntr brings along."""
    wntr = pytest.importorskip("wntr", reason="wntr is not installed")
    build("water")
    if source != "town.inp":
        shutil.copy(Path(wntr.__file__).parent / "library" / "networks" / source, "town.inp")
        assert "not modelled: 2 controls, 1 patterns" in execute("build").words
    expected = pressures(Path("town.inp"))
    values = {name: f"junction_{name}.pressure" for name in expected}
    found = result(modelica_library, "Town.Town", list(values.values()), Run(1, 1), tool)
    assert {name: found[value] for name, value in values.items()} == pytest.approx(expected, rel=1e-4)
