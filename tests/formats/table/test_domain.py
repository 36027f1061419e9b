"""Tables in projects: what users do, and what follows."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from support.commands import Execute
from support.networks import edit

from urdfsync.domain import Companion, Target
from urdfsync.engine.result import Exit
from urdfsync.formats.table.domain import DOMAIN
from urdfsync.formats.table.model import Table, TableOptions

MOTORS = "name,torque [N.cm],inertia [g.cm2],maker\nMX-64,600,12.5,Robotis\nXM 430,410,3,\n"
MODEL = """\
within << within >>;

model << class >> << name | string >>

  Records.<< class >> parameters;

  parameter Boolean strong = << (row.torque > 5) | lower >>;

end << class >>;
"""


@pytest.fixture
def project(folder: Path, execute: Execute) -> Path:
    """A project with a table of motors, its templates, and a first build; one model depends on a number."""
    Path("motors.csv").write_text(MOTORS)
    execute("init", "--domain", "table", "motors.csv")
    Path("templates/motors/model.mo.jinja").write_text(MODEL)
    assert "10 files written" in execute("build").out
    return folder


def test_the_templates_of_init_follow_the_columns(project: Path, execute: Execute) -> None:
    record = Path("modelica/Motors/Records/MX_64.mo")
    assert 'parameter String maker = "Robotis"' in record.read_text()
    assert "maker" not in Path("modelica/Motors/Records/XM_430.mo").read_text()
    Path("motors.csv").write_text("name,torque [N.cm],mass [g],maker\nMX-64,600,126,Robotis\nXM 430,410,82,\n")
    assert "2 files written" in execute("build").out
    assert 'parameter Real mass(final unit = "kg") = 0.126' in record.read_text()


def test_init_keeps_templates_that_are_there(project: Path, execute: Execute) -> None:
    Path("urdfsync.toml").unlink()
    found = execute("init", "--domain", "table", "motors.csv", code=Exit.ERROR)
    assert "templates/motors/record.mo.jinja: error: the template exists already; move it away" in found.words
    assert not Path("urdfsync.toml").exists()


def test_a_number_of_records_is_a_parameter(project: Path, execute: Execute) -> None:
    edit(Path("motors.csv"), "12.5", "12.6")
    found = execute("build").out
    assert "1 file written" in found
    assert "element MX-64: inertia 1.25e-06 → 1.26e-06 kg.m2" in found


def test_another_unit_renews_records(project: Path, execute: Execute) -> None:
    edit(Path("motors.csv"), "torque [N.cm]", "torque [kg]")
    assert "column torque: N.m → kg" in execute("build").out
    assert 'torque(final unit = "kg") = 600' in Path("modelica/Motors/Records/MX_64.mo").read_text()


def test_a_number_that_a_model_follows_is_structure(project: Path, execute: Execute) -> None:
    edit(Path("motors.csv"), "600", "700")
    assert "1 parameter change" in execute("diff", code=Exit.OUT_OF_STEP).out
    edit(Path("motors.csv"), "700", "300")
    found = execute("diff", code=Exit.OUT_OF_STEP).out
    assert "1 structural change" in found
    assert "update     modelica/Motors/Models/MX_64.mo" in found


def test_an_edit_follows_an_element_with_another_key(project: Path, execute: Execute) -> None:
    edit(Path("modelica/Motors/Models/XM_430.mo"), "  parameter Boolean", "  Real mine = 1;\n\n  parameter Boolean")
    edit(Path("motors.csv"), "XM 430", "MX-64 mk2")
    edit(Path("motors.csv"), "MX-64,", "XM 430,")
    assert "element XM 430: is now MX-64 mk2" in execute("build").out
    assert "Real mine = 1;" in Path("modelica/Motors/Models/MX_64_mk2.mo").read_text()
    assert "Real mine" not in Path("modelica/Motors/Models/XM_430.mo").read_text()


@pytest.mark.parametrize("rows", [
    "A,1,foo B,1,bar C,1,baz → B,1,foo C,1,bar D,1,baz",
    "A,1,foo B,0,bar C,2,baz → B,1,foo A,0,bar C,2,baz",
])  # fmt: skip
def test_edits_follow_rows_with_zeros_and_ones(folder: Path, execute: Execute, rows: str) -> None:
    old, new = (table.split() for table in rows.split(" → "))
    source = Path("p.csv")
    source.write_text("\n".join(["name,ratio [1],part", *old]))
    execute("init", "--domain", "table", "p.csv")
    execute("build")
    for row in old:
        edit(Path(f"modelica/P/Models/{row[0]}.mo"), "\nequation", f"\n  Real {row[-3:]};\n\nequation")
    source.write_text("\n".join(["name,ratio [1],part", *new]))
    execute("build")
    for row in new:
        assert f"Real {row[-3:]};" in Path(f"modelica/P/Models/{row[0]}.mo").read_text()


def test_two_sides_conflict(project: Path, execute: Execute) -> None:
    edit(Path("modelica/Motors/Records/MX_64.mo"), "= 6\n", "= 6.5\n")
    edit(Path("motors.csv"), "600", "700")
    assert "1 conflict" in execute("build", code=Exit.CONFLICT).out
    assert "= 6.5\n" in Path("modelica/Motors/Records/MX_64.mo").read_text()


def name_connections() -> None:
    with Path("urdfsync.toml").open("a") as file:
        file.write('connections = "motors.connections.csv"\n')


@pytest.mark.slow
def test_connections_never_vanish_in_silence(folder: Path, execute: Execute) -> None:
    table, connections = Path("motors.csv"), Path("motors.connections.csv")
    table.write_text(MOTORS)
    connections.write_text("from,to\nMX-64,XM 430\n")
    assert 'connections = "motors.connections.csv"' in execute("init", "--domain", "table", "motors.csv").words
    system = Path("templates/motors/system.mo.jinja")
    system.write_text(system.read_text().replace("end <<", "// << connections | length >> connection\nend <<"))
    execute("build")
    edit(Path("urdfsync.toml"), 'source = "motors.csv"', 'source = "drives.csv"')
    table.rename("drives.csv")
    assert "motors: in step" in execute("build").words
    connections.rename("away.csv")
    missing = "`connections` names motors.connections.csv, which can't be read: it does not exist; put the file there"
    for command in ("build", "check", "diff"):
        found = execute(command, code=Exit.ERROR).words
        assert f"urdfsync.toml:11: error: robot `motors`: {missing}, or correct `connections` [no-source]" in found
    assert "// 1 connection" in Path("modelica/Motors/Motors.mo").read_text()


def test_a_fault_in_the_connections_is_told_in_their_file(project: Path, execute: Execute) -> None:
    Path("motors.connections.csv").write_text("from,to\nMX-64,XM 430\nMX-64,gone\n")
    unnamed = execute("build", code=Exit.ERROR).words
    assert "urdfsync.toml:5: error: robot `motors`: motors.connections.csv stands beside the source" in unnamed
    name_connections()
    found = execute("build", code=Exit.ERROR)
    assert "motors.connections.csv:3: error: there is no element `gone`" in found.words


def test_a_template_with_an_absent_column_is_told(project: Path, execute: Execute) -> None:
    edit(Path("templates/motors/model.mo.jinja"), "row.torque", "row.speed")
    found = execute("build", code=Exit.ERROR)
    assert "templates/motors/model.mo.jinja:7: error: the template can't be rendered" in found.words


def test_an_emptied_cell_that_a_template_needs_is_an_error(project: Path, execute: Execute) -> None:
    edit(Path("motors.csv"), "MX-64,600", "MX-64,")
    found = execute("build", code=Exit.ERROR).words
    assert "model.mo.jinja:7: error: the template can't be rendered for `Models/MX_64.mo`" in found
    assert "`torque` has no value here: test it by `is defined`" in found


def test_a_wrong_kind_is_told_before_all_connections(project: Path, execute: Execute) -> None:
    Path("motors.connections.csv").write_text("from,to\nMX-64,XM 430\n")
    name_connections()
    with Path("urdfsync.toml").open("a") as file:
        file.write('kind = "sort"\n')
    assert "there is no column `sort`" in execute("build", code=Exit.ERROR).err
    assert "no element" not in execute("build", code=Exit.ERROR).err


@pytest.mark.slow
def test_any_key_becomes_a_component(folder: Path, execute: Execute, modelica_library: Path) -> None:
    keys = ["floor", "end", "time", "P-101", "P_101", "pump", "Pump", "Parts", "records"]
    keys += ["12", "---", "living room", "k" * 200]
    Path("parts.csv").write_text("\n".join(["name,mass [kg],time [s]", *(f"{key},1,2" for key in keys)]))
    Path("parts.connections.csv").write_text("from,to\nend,P-101\n")
    execute("init", "--domain", "table", "parts.csv")
    execute("build")
    system = Path("modelica/Parts/Parts.mo").read_text()
    names = re.findall(r"Models\.(\w+) (\w+)\n\s+\"(.*)\"\n\s+annotation \(Placement", system)
    assert [key for *_, key in names] == keys
    assert len({component.lower() for _, component, _ in names}) == len(keys)
    patterns = ["floor_H", "end_H", "time_H", "p_101_element_H", "p_101_element_H", "pump_element_H", "pump_element_H"]
    patterns += ["parts_element_H", "records_element_H", "element_12", "element", "living_room", f"{'k' * 93}_H"]
    for pattern, (name, component, key) in zip(patterns, names, strict=True):
        assert re.fullmatch(pattern.replace("H", "[0-9a-f]{6}"), component), key
        assert f'model {name} "{key}"' in Path(f"modelica/Parts/Models/{name}.mo").read_text()
    assert "Real time_(" in Path("modelica/Parts/Records/Living_room.mo").read_text()
    assert all(word in system for word in ("connect(end_", ".port_b, p_101", ".port_a)", "annotation (Line("))
    assert all(word in Path("modelica/Parts/Models/Living_room.mo").read_text() for word in ("Icon(", '"%name"'))
    assert "1 model compiles" in execute("check").out, modelica_library


def test_a_column_may_have_a_word_of_modelica_as_name(folder: Path, execute: Execute) -> None:
    Path("motors.csv").write_text("name,model\nm1,XL\n")
    execute("init", "--domain", "table", "motors.csv")
    execute("build")
    assert 'parameter String model_ = "XL"' in Path("modelica/Motors/Records/M1.mo").read_text()


def test_templates_are_needed_for_each_kind(project: Path, execute: Execute) -> None:
    with Path("urdfsync.toml").open("a") as file:
        file.write('kind = "maker"\n')
    edit(Path("motors.csv"), "410,3,", "410,3,Acme")
    found = execute("build", code=Exit.ERROR).words
    assert "there is no template `model/Robotis.mo.jinja`; write templates/motors/model/Robotis" in found


def test_the_record_of_a_domain_without_templates_has_all_columns() -> None:
    table = DOMAIN.read(MOTORS.encode(), "motors.csv", TableOptions()).snapshot
    assert isinstance(table, Table)
    assert DOMAIN.unit(table, ["elements", "MX-64", "inertia"]) == "kg.m2"
    assert DOMAIN.unit(table, ["elements", "MX-64", "maker"]) == ""


@pytest.mark.slow
def test_a_package_without_a_system_is_checked_model_by_model(
    project: Path, execute: Execute, modelica_library: Path
) -> None:
    found = execute("check", "--verbose").out
    assert "2 models compile" in found, modelica_library


@pytest.mark.slow
def test_a_check_names_each_edited_file(project: Path, execute: Execute, without_library: None) -> None:
    edit(Path("modelica/Motors/Records/MX_64.mo"), "= 6\n", "= 7\n")
    edit(Path("modelica/Motors/Records/XM_430.mo"), "end XM_430;", "  // a comment alone\nend XM_430;")
    found = execute("check", code=None)
    assert "Records/MX_64.mo (edited): its effect is not compared" in found.words
    assert "XM_430" not in found.out
    (check,) = json.loads(execute("check", "--format", "json", code=None).out)["results"]
    assert check["uncompared_edits"] == check["edited"] == ["Records/MX_64.mo"]


def test_the_page_shows_elements_and_connections(project: Path, execute: Execute) -> None:
    Path("motors.connections.csv").write_text("from,to\nMX-64,XM 430\n")
    name_connections()
    links = Companion("connections", "links.csv", b"from,to\nMX-64,XM 430\n")
    table = DOMAIN.read(MOTORS.encode(), "motors.csv", TableOptions(), links).snapshot
    picture, meshes = DOMAIN.pictures.scene(table, {}, Target("Motors", "Motors"), TableOptions())
    assert [body.element for body in picture.bodies] == ["table Motors", "element MX-64", "element XM 430"]
    assert [len(body.shapes) for body in picture.bodies] == [1, 1, 1]
    assert ("torque", "6 N.m") in picture.bodies[1].facts
    assert meshes == {}
    assert "page: " in execute("report", "-o", "motors.html").out
    assert '<section id="robot" aria-label="Table">' in Path("motors.html").read_text()


def test_the_package_has_the_order_of_the_rows(folder: Path, execute: Execute) -> None:
    Path("p.csv").write_text("name,mass [kg]\nzebra,1\nant,2\nmole,3\n")
    Path("p.connections.csv").write_text("from,to\nzebra,ant\nant,mole\n")
    execute("init", "--domain", "table", "p.csv")
    execute("build")
    order, system = Path("modelica/P/Records/package.order"), Path("modelica/P/P.mo")
    assert order.read_text().split() == ["Zebra", "Ant", "Mole"]
    assert re.findall(r"Models\.(\w+)", system.read_text()) == ["Zebra", "Ant", "Mole"]
    edit(Path("p.csv"), "ant,2", "ant,5")
    assert "1 parameter change since" in execute("diff", code=1).out, "the order is no change"
    edit(Path("p.csv"), "ant,5", "bear,4\nant,2")
    execute("build")
    assert order.read_text().split() == ["Zebra", "Bear", "Ant", "Mole"]
    edit(Path("p.csv"), "zebra,1\nbear,4\n", "bear,4\nzebra,1\n")
    Path("old.csv").write_text("name,mass [kg]\nzebra,1\nbear,4\nant,2\nmole,3\n")
    for command in (["diff"], ["diff", "p", "--against", "old.csv"]):
        assert "update     modelica/P/P.mo" in execute(*command, code=1).out
    execute("build")
    assert re.findall(r"Models\.(\w+)", system.read_text()) == ["Bear", "Zebra", "Ant", "Mole"]
    assert "in step" in execute("build", "--check").out
