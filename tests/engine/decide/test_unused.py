"""Templates that leave out parts of a model: diff and build agree, and both name what no text shows."""

from __future__ import annotations

from pathlib import Path

import pytest
import support.urdfs as urdfs
from support.commands import Execute
from support.networks import edit

RECORD = """\
within << within >>;

record << class >>
  parameter Real torque = << row.torque | real >>;
end << class >>;
"""
UNUSED = 'parts.csv: warning: no template uses column {}; use it in a template, or set `ignore = ["unused"]` [unused]'


@pytest.fixture
def parts(folder: Path, execute: Execute) -> Path:
    """A table, after a first build; the user's template of records reads one column."""
    source = folder / "parts.csv"
    source.write_text("name,torque [N.m],note\na,1,\nb,2,\n")
    execute("init", "--domain", "table", "parts.csv")
    Path("templates/parts/record.mo.jinja").write_text(RECORD)
    assert execute("build").errors == []
    return source


def test_a_column_that_no_template_reads_is_named_and_is_no_difference(parts: Path, execute: Execute) -> None:
    parts.write_text("name,torque [N.m],note,inertia [kg.m2]\na,1,x,0.5\nb,2,,0.7\n")
    for command in (["diff"], ["diff", "--against", "old.csv"], ["build", "--check"], ["build"]):
        Path("old.csv").write_text("name,torque [N.m],note\na,1,\nb,2,\n")
        found = execute(*command, *(["parts"] if "--against" in command else []))
        assert {UNUSED.format("inertia"), UNUSED.format("note")} <= set(found.errors), command
        assert "structural change" not in found.out
    edit(parts, "a,1,x", "a,1.5,y")
    assert "1 parameter and 4 unmodelled changes" in execute("diff", code=1).words


def test_a_column_that_one_model_reads_is_used(parts: Path, execute: Execute) -> None:
    model = Path("templates/parts/model.mo.jinja")
    edit(model, "\nequation", "<% if row.note is defined %>  parameter Real noted = 1;<% endif %>\n\nequation")
    edit(parts, "b,2,", "b,2,yes")
    assert execute("build").errors == []


def test_a_column_of_connections_is_named_too(parts: Path, execute: Execute) -> None:
    Path("parts.connections.csv").write_text("from,to,length [m]\na,b,1\n")
    with Path("urdfsync.toml").open("a") as file:
        file.write('connections = "parts.connections.csv"\n')
    found = execute("build").errors
    assert UNUSED.format("length").replace("column", "connection column") in found
    hint = UNUSED.format("").partition("; ")[2]
    assert f"parts.connections.csv:2: warning: connection a b is new, but no template uses it; {hint}" in found
    assert "column length, column to, a b: not modelled" in execute("diff").words


def test_a_number_that_the_users_template_of_a_robot_drops_is_told(folder: Path, execute: Execute) -> None:
    links = (urdfs.link("base", 1.0), urdfs.link("arm", 1.0))
    joint = urdfs.joint("swing", "continuous", "base", "arm")
    Path("arm.urdf").write_text(urdfs.robot(*links, joint))
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\ntemplates = "own"\n')
    Path("own/link").mkdir(parents=True)
    Path("own/link/record.mo.jinja").write_text(
        "within << within >>;\nrecord << record >>\n  extends UrdfSync.Records.Link;\nend << record >>;\n"
    )
    execute("build")
    # the joint's numbers are shown: their change hides nothing
    Path("arm.urdf").write_text(urdfs.robot(links[0], urdfs.link("arm", 1.0, rpy="0 0 0"), joint.replace("0.1", "0.2")))
    message = "arm.urdf:4: warning: link arm / inertial / origin / rpy[0] changed, but no template uses it"
    for command, code in ((["diff"], 1), (["build", "--check"], 1), (["status"], 1), (["build"], 0)):
        assert message in execute(*command, code=code).words, command
