"""Columns of two versions of a table: renamed ones, and numbers that jump."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute
from support.networks import edit

from urdfsync.domain import Companion, Version
from urdfsync.formats.table.columns import find_jumps, pairs
from urdfsync.formats.table.domain import DOMAIN
from urdfsync.formats.table.model import Table, TableOptions


def table(text: str) -> Table:
    """Read rows that blanks separate, and connections after a `;`."""
    rows, _, links = text.partition(" ; ")
    companions = [Companion("connections", "l.csv", "\n".join(links.split()).encode())] if links else []
    found = DOMAIN.read("\n".join(rows.split()).encode(), "t.csv", TableOptions(), *companions)
    assert isinstance(found.snapshot, Table), found.diagnostics
    return found.snapshot


PUMPS = "name,power[kW],maker A,3,x B,1.5,y C,11,z"
LINKS = "name,m[kg] A,1 B,2 ; from,to,length[m] A,B,3 B,A,4"


@pytest.mark.parametrize(("old", "new", "names"), [
    (PUMPS, PUMPS.replace("power", "P"), "power P"),
    (PUMPS, PUMPS.replace("power", "P").replace("maker", "brand"), "maker brand, power P"),
    (PUMPS, PUMPS.replace("power[kW]", "P[W]").replace("3,", "3000,").replace("1.5", "1500").replace("11", "11000"),
     "power P"),
    (PUMPS, PUMPS.replace("power", "P") + " D,4,w", "power P"),
    (PUMPS, PUMPS.replace("power", "P").replace("11", "12"), "power P"),
    (PUMPS, PUMPS.replace("power", "P").replace("11", "12").replace("1.5", "1.6"), ""),
    (PUMPS, PUMPS.replace("power[kW]", "mass[kg]"), ""),
    (PUMPS, PUMPS.replace("power[kW]", "power[kW],P[kW]").replace(",x", ",3,x").replace(",y", ",1.5,y")
     .replace(",z", ",11,z"), ""),
    ("name,brake[boolean] A,true B,false", "name,lamp[boolean] A,true B,false", "brake lamp"),
    ("name,brake[boolean] A,true B,true", "name,lamp[boolean] A,true B,true", ""),
    ("name,low[m],mid[m] A,5,5 B,6,6", "name,bottom[m],middle[m] A,5,5 B,6,6", ""),
    (LINKS, LINKS.replace("length", "distance"), "length distance"),
])  # fmt: skip
def test_a_column_of_mostly_equal_cells_is_renamed(old: str, new: str, names: str) -> None:
    found = pairs(table(old), table(new))
    assert sorted(f"{name} {now}" for (_, name), (_, now) in found.items()) == names.split(", " if names else None)


def test_too_many_columns_are_not_compared() -> None:
    old, new = (
        Table({f"{name}{n}": "m" for n in range(1500)}, {"A": {f"{name}{n}": n + 0.5 for n in range(1500)}})
        for name in "ab"
    )
    assert pairs(old, new) == {}


@pytest.mark.parametrize(("old", "new", "words"), [
    (PUMPS, PUMPS.replace("kW", "W"),
     "column power jumps by a factor of 0.001: element A from 3000 to 3 W (and 2 more like it)"),
    ("name,d[mm] A,10 B,20", "name,d[in] A,10 B,20",
     "column d jumps by a factor of 25.4: element A from 0.01 to 0.254 m (and 1 more like it)"),
    ("name,angle[rad] A,1 B,0", "name,angle[deg] A,1 B,0",
     "column angle jumps by a factor of 0.0174533: element A from 1 to 0.0174533 rad"),
    ("name,angle[rad] A,1 B,2", "name,angle[rad] A,57.3 B,114.6",
     "column angle jumps by a factor of 57.3: element A from 1 to 57.3 rad (and 1 more like it)"),
    ("name,p[bar] A,1 B,2 C,3", "name,p[psi] A,1 B,2 C,3",
     "column p jumps by a factor of 0.0689476: element A from 100000 to 6894.76 Pa (and 2 more like it)"),
    ("name,p[bar] A,1 B,2", "name,p[Pa] A,1 B,2",
     "column p jumps by a factor of 1e-05: element A from 100000 to 1 Pa (and 1 more like it)"),
    ("name,T[degC] A,20 B,1", "name,T[K] A,20 B,1",
     "column T jumps by 273.15 K: element A from 293.15 to 20 K (and 1 more like it)"),
    ("name,n[integer] A,4 B,6", "name,n[integer] A,4000 B,6000",
     "column n jumps by a factor of 1000: element A from 4 to 4000 (and 1 more like it)"),
    (LINKS, LINKS.replace("[m]", "[mm]"),
     "connection column length jumps by a factor of 0.001: connection A B from 3 to 0.003 m (and 1 more like it)"),
    (PUMPS, PUMPS.replace("kW", "W").replace("11", "11.5"),
     "column power jumps by a factor of 0.001: element A from 3000 to 3 W (and 1 more like it)"),
    (PUMPS, PUMPS.replace("3,", "3000,"), ""),
    ("name,U[V] A,12 B,12 C,12", "name,U[V] A,48 B,48 C,48", ""),
    ("name,m[kg] A,1 B,2", "name,m[kg] A,1e300 B,-1e-300", ""),
    (PUMPS, PUMPS.replace("[kW]", "[kN]"), ""),
])  # fmt: skip
def test_a_column_that_jumps_by_the_ratio_of_two_units_is_told(old: str, new: str, words: str) -> None:
    found = list(find_jumps(Version(table(old)), Version(table(new)), {}))
    assert [one.message for one in found] == [words] * bool(words)
    assert {one.code for one in found} <= {"unit-jump"}


def test_a_jump_is_told_by_a_build_in_its_line(folder: Path, execute: Execute) -> None:
    Path("p.csv").write_text("\n".join(PUMPS.split()))
    execute("init", "--domain", "table", "p.csv")
    execute("build")
    Path("p.csv").write_text("\n".join(PUMPS.replace("kW", "W").split()))
    assert (
        "p.csv:2: warning: since this export: column power jumps by a factor of 0.001: element A"
        in execute("build").words
    )
    edit(Path("urdfsync.toml"), "[robots.p]", '[defaults]\nignore = ["unit-jump"]\n\n[robots.p]')
    edit(Path("p.csv"), "[W]", "[kW]")
    assert "unit-jump" not in execute("build").words


def test_edits_follow_a_renamed_column(folder: Path, execute: Execute) -> None:
    Path("p.csv").write_text("\n".join(PUMPS.split()))
    execute("init", "--domain", "table", "p.csv")
    execute("build")
    record, model = Path("modelica/P/Records/A.mo"), Path("modelica/P/Models/B.mo")
    edit(record, "= 3000", "= 3200")
    edit(model, "\nequation", "\n  Real loss = parameters.power / 10;\n\nequation")
    edit(Path("p.csv"), "power[kW],maker", "rated power [kW],brand")
    edit(Path("p.csv"), "A,", "pump A,")
    found = execute("diff", code=None).out
    assert "column power: renamed to rated power" in found
    assert "~3 (3 structural changes) since the last build" in found
    execute("build", code=None)
    execute("resolve", "p", "--merge")
    assert (
        'parameter Real rated_power(final unit = "W") = 3200\n    "rated power";'
        in record.with_stem("Pump_A").read_text()
    )
    assert "Real loss = parameters.rated_power / 10;" in model.read_text()
    assert "in step" in execute("build", "--check").out
