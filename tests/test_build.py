"""Builds of the RC network domain: what is written, what is left alone, and what is refused."""

from __future__ import annotations

import errno
import json
import os
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest
from support.crashes import Operation, before_each

from urdfsync import config, files
from urdfsync.engine import imports
from urdfsync.engine.actions import Kind
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.files import text_digest
from urdfsync.outcome import Exit, Result, exit_code
from urdfsync.state import file_operations

Snapshot = Callable[[Path], dict[str, tuple[int, bytes]]]

LADDER = "modelica/Ladder"


def run(**request: Any) -> Result:
    """Build the robot `ladder` of the working folder."""
    (result,) = run_all(**request)
    return result


def run_all(**request: Any) -> list[Result]:
    loaded = config.load(Path("urdfsync.toml"))
    return list(build(loaded, loaded.robots, BuildOptions(**request)))


def kinds(result: Result) -> dict[str, Kind]:
    """What happens to each file that does not just stay, by its path in the package."""
    return {
        action.path.removeprefix(f"{LADDER}/"): action.kind
        for action in result.actions
        if action.kind is not Kind.UNCHANGED and not action.held
    }


def waiting(result: Result) -> set[str]:
    return {action.path.removeprefix(f"{LADDER}/") for action in result.actions if action.held}


def edit(path: Path, old: str, new: str) -> None:
    text = path.read_bytes().decode()
    assert old in text
    path.write_bytes(text.replace(old, new).encode())


def configure(project: Path, **keys: str) -> None:
    """Set keys of the robot; the values are TOML."""
    lines = {"source": '"ladder.json"', "package": '"Ladder"', "domain": '"rcnetwork"'} | keys
    text = "\n".join(f"{key} = {value}" for key, value in lines.items())
    (project / "urdfsync.toml").write_text(f"[robots.ladder]\n{text}\n")


def manifest_of(project: Path) -> dict[str, Any]:
    return tomllib.loads((project / ".urdfsync/robots/ladder.toml").read_text())


def failure(**request: Any) -> str:
    result = run(**request)
    assert result.failed
    assert exit_code([result]) is Exit.ERROR
    return "\n".join(map(str, result.diagnostics))


# What a build writes


def test_a_first_build_writes_the_package(project: Path) -> None:
    result = run()
    assert set(kinds(result).values()) == {Kind.CREATE}
    written = {path.relative_to(project / LADDER).as_posix() for path in (project / LADDER).rglob("*.*")}
    assert written == set(kinds(result))
    assert (project / LADDER / "package.order").read_text() == "Elements\nLadder\n"
    assert "R = 220.5" in (project / LADDER / "Elements/R2Parameters.mo").read_text()
    assert (project / LADDER / "Resources/step.txt").read_text().startswith("#1\ndouble signal(4, 2)\n")


def test_a_second_build_writes_nothing(project: Path, snapshot_of: Snapshot) -> None:
    run()
    before = snapshot_of(project)
    assert run().in_step
    assert run(full=True).in_step
    assert snapshot_of(project) == before


def test_a_build_elsewhere_gives_the_same_bytes(
    project: Path, tmp_path: Path, snapshot_of: Snapshot, monkeypatch: pytest.MonkeyPatch
) -> None:
    other = tmp_path / "quite" / "another place"
    shutil.copytree(project, other)
    run()
    monkeypatch.chdir(other)
    run()
    contents = [{path: content for path, (_, content) in snapshot_of(folder).items()} for folder in (project, other)]
    noted = [files.pop(".urdfsync/folders.json") for files in contents]  # bound to its inode, and ignored by git
    assert contents[0] == contents[1]
    assert noted[0] != noted[1]
    assert str(tmp_path).encode() not in b"".join(contents[0].values())


def heavy_after_a_build(*folders: Path) -> list[str]:
    """What a `build` in a process of its own prints, and which of the heavy modules it has imported."""
    code = (
        "import sys; from urdfsync.cli import main; code = main(['build']); "
        "print([name for name in ('jinja2', 'rich', 'lxml', 'numpy', 'yourdfpy', 'deepdiff') if name in sys.modules])"
    )
    path = os.pathsep.join(map(str, (Path(files.__file__).parents[1], *folders)))
    environment = os.environ | {"PYTHONPATH": path}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    return done.stdout.splitlines()


def test_a_no_op_of_a_urdf_imports_nothing_heavy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    mesh = '<visual><geometry><mesh filename="tip.stl"/></geometry></visual>'
    Path("arm.urdf").write_text(f'<robot name="arm"><link name="base">{mesh}</link></robot>')
    Path("tip.stl").write_text(
        "solid tip\nfacet normal 0 0 1\nouter loop\n"
        "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0.5\nendloop\nendfacet\nendsolid\n"
    )
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    assert not run().failed
    headline, heavy = heavy_after_a_build()
    assert headline.startswith("arm: in step, ")
    assert heavy == "[]"


def test_a_dry_run_writes_nothing_and_says_the_same(project: Path, snapshot_of: Snapshot) -> None:
    before = snapshot_of(project)
    planned = run(dry=True)
    assert snapshot_of(project) == before
    assert planned.actions == run().actions


def test_changed_white_space_touches_nothing(project: Path, snapshot_of: Snapshot) -> None:
    run()
    before = snapshot_of(project / LADDER)
    edit(project / "ladder.json", "  ", "    ")
    assert run().in_step
    assert snapshot_of(project / LADDER) == before
    assert run().in_step


def test_a_removed_element_takes_its_files_along(project: Path) -> None:
    run()
    edit(project / "ladder.json", '{"name": "R1", "between": ["in", "middle"], "ohm": 100},', "")
    edit(project / "ladder.json", '"drives": "in"', '"drives": "out"')
    assert kinds(run()) == {
        "Elements/R1.mo": Kind.DELETE,
        "Elements/R1Parameters.mo": Kind.DELETE,
        "Elements/package.order": Kind.UPDATE,
        "Ladder.mo": Kind.UPDATE,
    }
    assert not (project / LADDER / "Elements/R1.mo").exists()
    assert "R1" not in (project / LADDER / "Elements/package.order").read_text()
    assert not [path for path in manifest_of(project)["files"] if "R1" in path]


def test_a_changed_option_or_template_renders_again(project: Path) -> None:
    run()
    configure(project, prefix='"pin"')
    assert kinds(run()) == {"Ladder.mo": Kind.UPDATE}
    template = project / "own/element/parameters.mo.jinja"
    template.parent.mkdir(parents=True)
    template.write_text(
        "within << package >>.Elements;\nrecord << element.name >>Parameters\nend << element.name >>Parameters;\n"
    )
    configure(project, prefix='"pin"', templates='"own"')
    assert set(kinds(run())) == {f"Elements/{name}Parameters.mo" for name in ("C1", "C2", "R1", "R2")}
    edit(template, "record", "record  ")
    assert set(kinds(run()).values()) == {Kind.UPDATE}
    assert run().in_step


def test_a_package_that_moves_takes_edits_along_and_leaves_what_is_the_users(project: Path) -> None:
    run()
    (project / LADDER / "Bench.mo").write_text("within Ladder;\nmodel Bench\nend Bench;\n")
    edit(project / LADDER / "package.order", "Ladder\n", "Bench\nLadder\n")
    edit(project / LADDER / "Elements/R1.mo", "end R1;", "// mine\nend R1;")
    edit(project / LADDER / "Ladder.mo", "end Ladder;", "// mine, too\nend Ladder;")
    configure(project, package='"Filter"')
    result = run()
    left = {path.relative_to(project / LADDER).as_posix() for path in (project / LADDER).rglob("*.*")}
    assert left == {"package.mo", "package.order", "Bench.mo"}
    moved = (project / "modelica/Filter/Elements/R1.mo").read_text()
    assert moved.startswith("within Filter.Elements;\n")
    assert moved.endswith("// mine\nend R1;\n")
    assert (project / "modelica/Filter/Filter.mo").read_text().endswith("// mine, too\nend Filter;\n")
    assert (project / LADDER / "package.order").read_text() == "Bench\n"
    assert [str(found).replace("\\", "/") for found in result.diagnostics] == [
        "urdfsync.toml:1: warning: the package moved from modelica/Ladder to modelica/Filter; what you wrote or "
        "edited, and what that needs, stayed behind: modelica/Ladder/Bench.mo, modelica/Ladder/package.mo, "
        "modelica/Ladder/package.order; take over what you need, then delete the old folder [left-behind]"
    ]
    assert run().in_step
    assert run().diagnostics == ()


def test_a_package_that_cant_move_stays(project: Path, snapshot_of: Snapshot) -> None:
    run()
    foreign = project / "modelica/Filter/Ladder.mo"
    foreign.parent.mkdir()
    foreign.write_text("mine")
    configure(project, package='"Filter"', **{"class": '"Ladder"'})
    before = snapshot_of(project / LADDER)
    for _ in range(2):
        assert exit_code([run()]) is Exit.CONFLICT
        assert snapshot_of(project / LADDER) == before
    foreign.unlink()
    assert exit_code([run()]) is Exit.IN_STEP
    assert not (project / LADDER).exists()


def rename_robot(project: Path, name: str = "filter") -> None:
    edit(project / "urdfsync.toml", "[robots.ladder]", f"[robots.{name}]")


def test_a_robot_with_another_name_takes_its_state_along(project: Path) -> None:
    run()
    edit(project / LADDER / "Elements/R1.mo", "end R1;", "// mine\nend R1;")
    edit(project / "ladder.json", "4.7e-6", "1e-5")
    rename_robot(project)
    assert [found.code for found in run(dry=True).diagnostics] == ["renamed-robot"]
    result = run()
    assert kinds(result) == {"Elements/R1.mo": Kind.KEEP, "Elements/C2Parameters.mo": Kind.UPDATE}
    assert [str(found) for found in result.diagnostics] == [
        "urdfsync.toml:1: note: robot `filter` was called `ladder`; "
        "what urdfsync recorded of it goes with the new name [renamed-robot]"
    ]
    states = {path.name for path in (project / ".urdfsync/robots").iterdir()}
    assert states == {"filter.toml", "filter.json"}
    assert run().diagnostics == ()


def test_state_of_robots_that_are_gone_is_mentioned_once_and_kept(project: Path) -> None:
    run()
    rename_robot(project)
    configure_text = (project / "urdfsync.toml").read_text().replace('"Ladder"', '"Filter"')
    (project / "urdfsync.toml").write_text(
        configure_text + '[robots.third]\nsource = "ladder.json"\npackage = "Third"\ndomain = "rcnetwork"\n'
    )
    for _ in range(2):
        first, second = run_all()
        assert [str(found).replace("\\", "/") for found in first.diagnostics] == [
            "urdfsync.toml: note: the state of `ladder` is still there, but the configuration has no such robot; "
            "bring the robot back, or delete .urdfsync/robots/ladder.* and what is left of its package [stray-state]"
        ]
        assert second.diagnostics == ()
        assert (project / ".urdfsync/robots/ladder.toml").exists()
        assert (project / LADDER / "package.mo").exists()


def test_the_manifest_says_what_was_built(project: Path) -> None:
    run()
    recorded = manifest_of(project)
    assert recorded["source"]["path"] == "ladder.json"
    assert recorded["names"] == {"elements": {name: name for name in ("C1", "C2", "R1", "R2")}}
    assert recorded["files"]["Elements/R1.mo"] == {
        "owner": "element R1",
        "role": "model",
        "base": files.digest((project / LADDER / "Elements/R1.mo").read_bytes()),
    }
    assert recorded["dependencies"]["step.csv"]["target"] == "Resources/step.txt"
    model = json.loads((project / ".urdfsync/robots/ladder.json").read_text())
    assert model["snapshot"]["elements"]["R1"]["ohm"] == 100
    assert (project / ".urdfsync/.gitignore").read_text().splitlines()[1:] == [
        "/*",
        "!/.gitignore",
        "!/robots/",
    ]


def test_a_drawing_goes_into_the_state_folder(project: Path) -> None:
    result = run(draw=True)
    assert result.drawing == project / ".urdfsync/svg/ladder.svg"
    assert result.drawing.read_text().startswith("<svg")


# Hand edits


def test_an_edited_file_survives(project: Path) -> None:
    run()
    model = project / LADDER / "Elements/R1.mo"
    edit(model, "v = parameters.R*i;", "v = 2*parameters.R*i;")
    mine = model.read_bytes()
    for request in ({}, {"full": True}, {"dry": True}):
        result = run(**request)
        assert kinds(result) == {"Elements/R1.mo": Kind.KEEP}
        assert result.in_step
    edit(project / "ladder.json", '"ohm": 100', '"ohm": 120')
    assert kinds(run()) == {"Elements/R1.mo": Kind.KEEP, "Elements/R1Parameters.mo": Kind.UPDATE}
    assert model.read_bytes() == mine
    assert manifest_of(project)["files"]["Elements/R1.mo"]["state"] == "edited"


def test_a_build_may_only_record_what_the_user_did(project: Path, snapshot_of: Snapshot) -> None:
    run()
    edit(project / LADDER / "Elements/R1.mo", "end R1;", "// mine\nend R1;")
    before, package = snapshot_of(project), snapshot_of(project / LADDER)
    result = run()
    assert result.in_step
    assert result.renews_state
    assert snapshot_of(project / LADDER) == package
    after = snapshot_of(project)
    assert [path for path in after if before.get(path) != after[path]] == [".urdfsync/robots/ladder.toml"]
    assert not run().renews_state
    assert snapshot_of(project) == after


def test_what_was_written_before_a_save_came_in_between_is_told(project: Path) -> None:
    run()
    edit(project / "ladder.json", '"ohm": 100', '"ohm": 120')
    edit(project / "ladder.json", "220.5", "330")
    record, count = project / LADDER / "Elements/R2Parameters.mo", 0

    def save(operation: Operation) -> None:
        nonlocal count
        if operation.name in ("exchange", "replace") and record in operation.paths and count == 0:
            count += 1
            edit(record, "end R2", "// mine\nend R2")

    with before_each(save):
        result = run()
    assert count == 1
    assert kinds(result) == {"Elements/R1Parameters.mo": Kind.UPDATE, "Elements/R2Parameters.mo": Kind.CONFLICT}
    assert result.changes is not None
    assert {change.element for change in result.changes.changes} == {"R1", "R2"}
    assert "// mine" in record.read_text()


def test_line_endings_are_no_edit(project: Path) -> None:
    run()
    model = project / LADDER / "Elements/R1.mo"
    model.write_bytes(model.read_bytes().replace(b"\n", b"\r\n"))
    assert kinds(run()) == {}
    assert kinds(run(full=True)) == {}


def test_a_deleted_file_comes_back(project: Path) -> None:
    run()
    (project / LADDER / "Elements/R1.mo").unlink()
    (project / LADDER / "Elements/package.order").unlink()
    assert kinds(run()) == {"Elements/R1.mo": Kind.RESTORE, "Elements/package.order": Kind.RESTORE}


def test_a_class_made_a_package_counts_as_edited(project: Path) -> None:
    run()
    model = project / LADDER / "Elements/R1.mo"
    model.unlink()
    (model.with_suffix("")).mkdir()
    (model.with_suffix("") / "package.mo").write_text("within Ladder.Elements;\npackage R1\nend R1;\n")
    assert kinds(run()) == {"Elements/R1.mo": Kind.KEEP}
    assert not model.exists()


def conflict(project: Path, change: Sequence[str]) -> Result:
    """Edit the network's model, then change the source."""
    run()
    edit(project / LADDER / "Ladder.mo", "end Ladder;", "// mine\nend Ladder;")
    edit(project / "ladder.json", *change)
    return run()


def test_a_conflict_holds_back_structure_but_not_numbers(project: Path, snapshot_of: Snapshot) -> None:
    run()
    before = snapshot_of(project / LADDER)
    edit(project / "ladder.json", '"ohm": 100', '"ohm": 120')
    result = conflict(project, ['"R2"', '"R3"'])
    assert exit_code([result]) is Exit.CONFLICT
    assert kinds(result) == {"Ladder.mo": Kind.CONFLICT}
    orders = {"Elements/package.order"}
    assert waiting(result) == orders | {f"Elements/R{n}{kind}.mo" for n in "23" for kind in ("", "Parameters")}
    after = snapshot_of(project / LADDER)
    assert {path for path in before if before[path] != after[path]} == {"Ladder.mo", "Elements/R1Parameters.mo"}
    assert b"// mine" in after["Ladder.mo"][1]


def test_a_conflict_stays_until_it_is_settled(project: Path) -> None:
    first = conflict(project, ['"R2"', '"R3"'])
    again = run()
    assert (kinds(again), waiting(again)) == (kinds(first), waiting(first))
    assert exit_code([again]) is Exit.CONFLICT
    (project / LADDER / "Ladder.mo").unlink()
    settled = run()
    assert exit_code([settled]) is Exit.IN_STEP
    assert kinds(settled)["Ladder.mo"] is Kind.RESTORE
    assert kinds(settled)["Elements/R3.mo"] is Kind.CREATE
    assert not (project / LADDER / "Elements/R2.mo").exists()
    assert run().in_step


def test_a_conflict_ends_when_the_source_comes_back(project: Path) -> None:
    conflict(project, ['"R2"', '"R3"'])
    edit(project / "ladder.json", '"R3"', '"R2"')
    assert kinds(run()) == {"Ladder.mo": Kind.KEEP}


def test_a_file_of_the_user_in_the_way_is_a_conflict(project: Path) -> None:
    foreign = project / LADDER / "Ladder.mo"
    foreign.parent.mkdir(parents=True)
    foreign.write_text("mine")
    result = run()
    assert kinds(result) == {"Ladder.mo": Kind.UNOWNED, "Resources/step.txt": Kind.CREATE}
    assert foreign.read_text() == "mine"
    foreign.unlink()
    assert exit_code([run()]) is Exit.IN_STEP


def test_an_edited_file_that_is_no_longer_generated_is_kept(project: Path) -> None:
    run()
    record = project / LADDER / "Elements/R2Parameters.mo"
    edit(record, "220.5", "330")
    edit(project / "ladder.json", '"R2"', '"R3"')
    edit(project / "ladder.json", "220.5", "330")
    result = run()
    assert kinds(result)["Elements/R2Parameters.mo"] is Kind.ORPHAN
    assert "330" in record.read_text()
    assert kinds(run()) == {"Elements/R2Parameters.mo": Kind.ORPHAN}
    record.unlink()
    assert kinds(run()) == {"Elements/R2Parameters.mo": Kind.FORGET, "Elements/package.order": Kind.UPDATE}
    assert kinds(run()) == {}


def test_an_edited_model_that_is_no_longer_generated_keeps_its_record(project: Path) -> None:
    run()
    elements = project / LADDER / "Elements"
    edit(elements / "R2.mo", "end R2;", "// mine\nend R2;")
    edit(project / "ladder.json", '"R2"', '"R3"')
    edit(project / "ladder.json", "220.5", "330")
    orphans = {"Elements/R2.mo": Kind.ORPHAN, "Elements/R2Parameters.mo": Kind.NEEDED}
    assert kinds(run()).items() >= orphans.items()
    assert "R2Parameters" in (elements / "R2.mo").read_text()
    assert (elements / "R2Parameters.mo").exists()
    lines = (elements / "package.order").read_text().split()
    assert {"R2", "R2Parameters", "R3", "R3Parameters"} <= set(lines), "a class that stays keeps its line"
    for request in ({}, {"full": True}):
        assert kinds(run(**request)) == orphans
        assert run(**request).in_step
    (elements / "R2.mo").unlink()
    gone = {"Elements/R2.mo": Kind.FORGET, "Elements/R2Parameters.mo": Kind.DELETE}
    assert kinds(run()) == {**gone, "Elements/package.order": Kind.UPDATE}
    assert kinds(run()) == {}


def test_lost_state_is_found_again_as_far_as_files_agree(project: Path) -> None:
    run()
    edit(project / LADDER / "Ladder.mo", "end Ladder;", "// mine\nend Ladder;")
    shutil.rmtree(project / ".urdfsync")
    result = run()
    assert kinds(result).pop("Ladder.mo") is Kind.UNOWNED
    assert set(kinds(result).values()) == {Kind.UNOWNED, Kind.ADOPT}


def test_lines_of_the_user_stay_in_order_files(project: Path) -> None:
    run()
    order = project / LADDER / "package.order"
    order.write_bytes(b"Elements\r\nBench\r\nLadder\r\n")
    assert kinds(run()) == {}
    configure(project, **{"class": '"Network"'})
    assert kinds(run())["package.order"] is Kind.UPDATE
    assert order.read_bytes() == b"Elements\r\nNetwork\r\nBench\r\n"


# The packages around


def parent(project: Path, name: str = "Plant", order: str = "Other\n") -> Path:
    folder = project / "modelica" / name
    folder.mkdir(parents=True)
    (folder / "package.mo").write_text(f"package {name}\nend {name};\n")
    (folder / "package.order").write_text(order)
    return folder


def test_the_parent_lists_the_package(project: Path) -> None:
    plant = parent(project)
    configure(project, package='"Plant.Ladder"')
    run()
    assert (plant / "package.order").read_text() == "Other\nLadder\n"
    assert "within Plant;" in (plant / "Ladder/package.mo").read_text()
    assert run().in_step
    configure(project, package='"Ladder"')
    run()
    assert (plant / "package.order").read_text() == "Other\n"
    assert not (plant / "Ladder").exists()


def test_a_missing_parent_is_refused(project: Path, snapshot_of: Snapshot) -> None:
    configure(project, package='"Plant.Ladder"')
    before = snapshot_of(project)
    assert failure() == (
        "urdfsync.toml:3: error: robot `ladder`: the parent package `Plant` does not exist in modelica; "
        "create it, or set `create_parents = true` [no-parent]"
    )
    assert snapshot_of(project) == before


def test_missing_parents_are_made_if_the_configuration_says_so(project: Path) -> None:
    plant = parent(project)
    configure(project, package='"Plant.Filters.Passive.Ladder"', create_parents="true")
    run()
    assert (plant / "package.order").read_text() == "Other\nFilters\n"
    assert (plant / "Filters/package.order").read_text() == "Passive\n"
    assert (plant / "Filters/Passive/package.order").read_text() == "Ladder\n"
    text = 'within Plant.Filters;\npackage Passive "Passive"\nend Passive;\n'
    assert (plant / "Filters/Passive/package.mo").read_text() == text
    edit(plant / "Filters/package.mo", '"Filters"', '"All filters"')
    assert run().in_step


def test_a_top_level_package_that_is_made_says_what_it_needs(project: Path) -> None:
    configure(project, package='"Plant.Ladder"', create_parents="true")
    assert run().diagnostics == ()
    annotation = '  annotation (uses(Modelica(version="4.0.0")));'
    text = (project / "modelica/Plant/package.mo").read_text()
    assert text == f'within;\npackage Plant "Plant"\n{annotation}\nend Plant;\n'


def test_a_top_level_package_that_does_not_say_what_it_needs_is_a_warning(project: Path) -> None:
    parent(project)
    configure(project, package='"Plant.Ladder"')
    assert [str(found).replace("\\", "/") for found in run().diagnostics] == [
        "modelica/Plant/package.mo: warning: package `Plant` does not say that it needs Modelica; "
        'add `uses(Modelica(version="4.0.0"))` to its annotation [no-uses]'
    ]


def test_a_parent_in_a_single_file_is_refused(project: Path) -> None:
    (project / "modelica").mkdir()
    (project / "modelica/Plant.mo").write_text("package Plant end Plant;")
    configure(project, package='"Plant.Ladder"', create_parents="true")
    assert "package `Plant` is the single file modelica/Plant.mo" in failure().replace("\\", "/")


# What is refused


@pytest.mark.parametrize(
    ("output", "make", "words"),
    [
        ("lib", "file", "the output folder lib can't be made: lib is no folder"),
        ("lib/deep", "file", "can't be made: lib is no folder"),
        ("../elsewhere", "", "does not exist; create it"),
        ("lib", "package", "the output folder lib is a Modelica package itself"),
    ],
)
def test_outputs_that_cant_be(project: Path, output: str, make: str, words: str) -> None:
    if make == "file":
        (project / "lib").write_text("")
    elif make == "package":
        (project / "lib").mkdir()
        (project / "lib/package.mo").write_text("")
    configure(project, output=f'"{output}"')
    message = failure(trusted=True).replace("\\", "/")
    assert message.startswith("urdfsync.toml:5: error: ")
    assert words in message


@pytest.mark.parametrize("place", [LADDER, f"{LADDER}/Elements", f"{LADDER}/Elements/R1.mo"])
@pytest.mark.parametrize("kind", ["link", "other"])
def test_what_is_in_the_way_is_left_alone(project: Path, tmp_path: Path, place: str, kind: str) -> None:
    outside = tmp_path / "outside"
    outside.mkdir()
    path = project / place
    path.parent.mkdir(parents=True)
    if kind == "link":
        path.symlink_to(outside, target_is_directory=True)
    elif path.suffix:
        path.mkdir()
    else:
        path.write_text("mine")
    message = failure()
    assert message.startswith(str(Path(place)))
    assert "[output-in-the-way]" in message
    assert not list(outside.iterdir())
    assert not (project / ".urdfsync").exists()


@pytest.mark.parametrize(
    ("error", "hint"),
    [
        (errno.ENOSPC, "free some space on the disk"),
        (errno.EACCES, "check the permissions of the file and of its folder"),
    ],
)
def test_a_disk_that_refuses_changes_nothing(
    project: Path, monkeypatch: pytest.MonkeyPatch, snapshot_of: Snapshot, error: int, hint: str
) -> None:
    run()
    before = snapshot_of(project)
    edit(project / "ladder.json", '"R2"', '"R3"')
    real = file_operations.write

    def refuse(path: Path, content: bytes, like: Path | None = None) -> None:
        if like is not None and like.name == "R3.mo":
            raise OSError(error, os.strerror(error), path)
        real(path, content, like)

    monkeypatch.setattr(file_operations, "write", refuse)
    place = Path(LADDER) / "Elements" / "R3.mo"
    reason = f"it can't be written: {os.strerror(error)}"
    assert failure() == f"{place}: error: {reason}; {hint}; then build again [output-not-writable]"
    monkeypatch.undo()
    changed = {path for path, entry in snapshot_of(project).items() if before.get(path) != entry}
    assert {path for path in changed if not path.startswith(".urdfsync/base/")} == {"ladder.json"}


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes on this system")
@pytest.mark.parametrize(
    ("place", "words"),
    [
        ("ladder.json", "urdfsync.toml:2: error: robot `ladder`: the source ladder.json is no regular file"),
        (f"{LADDER}/Ladder.mo", "no regular file is where urdfsync would write a file"),
        (f"{LADDER}/package.order", "no regular file is where urdfsync would write a file"),
        (f"{LADDER}/Resources/step.txt", "no regular file is where urdfsync would write a file"),
        (".urdfsync/robots/ladder.toml", "no regular file is where urdfsync would write a file"),
        (".urdfsync/robots/ladder.json", "no regular file is where urdfsync would write a file"),
    ],
)
def test_a_pipe_does_not_stop_the_build_for_ever(project: Path, place: str, words: str) -> None:
    run()
    (project / place).unlink()
    os.mkfifo(project / place)
    message = failure().replace("\\", "/")
    assert words in message
    assert message.count("error: ") == 1


def test_a_pipe_for_a_dependency_counts_as_not_found(project: Path) -> None:
    (project / "step.csv").unlink()
    (project / "step.csv").mkdir()
    assert [found.code for found in run().diagnostics] == ["table-not-found"]


@pytest.mark.parametrize("name", ["", "robots", "robots/ladder.toml", "robots/ladder.json"])
def test_state_behind_a_link_is_refused(project: Path, tmp_path: Path, snapshot_of: Snapshot, name: str) -> None:
    run()
    path = project / ".urdfsync" / name
    path.rename(tmp_path / "elsewhere")
    path.symlink_to(tmp_path / "elsewhere")
    before = snapshot_of(tmp_path)
    assert "a symbolic link is where " in failure()
    assert snapshot_of(tmp_path) == before


def test_a_gitignore_of_the_user_stays(project: Path) -> None:
    ignore = project / ".urdfsync/.gitignore"
    ignore.parent.mkdir()
    ignore.write_bytes(b"svg/\n\xff")
    run()
    assert ignore.read_bytes() == b"svg/\n\xff"


def test_a_broken_source_changes_nothing(project: Path, snapshot_of: Snapshot) -> None:
    run()
    edit(project / "ladder.json", '"ohm": 100', '"ohm": 100, "farad": 1')
    before = snapshot_of(project)
    assert failure() == "ladder.json:6: error: element `R1` needs either `ohm` or `farad` [element-value]"
    assert snapshot_of(project) == before


def test_a_missing_source(project: Path) -> None:
    (project / "ladder.json").unlink()
    assert failure() == (
        "urdfsync.toml:2: error: robot `ladder`: the source ladder.json does not exist; "
        "correct `source`, or export the file again [no-source]"
    )


def test_a_missing_template_folder(project: Path) -> None:
    configure(project, templates='"own"')
    assert failure() == (
        "urdfsync.toml:5: error: robot `ladder`: the template folder own does not exist; "
        "create it, or take `templates` out [no-templates]"
    )


def test_a_recorded_model_of_the_wrong_shape_is_read_again(project: Path) -> None:
    run()
    model = project / ".urdfsync/robots/ladder.json"
    state = project / ".urdfsync/robots/ladder.toml"
    recorded = text_digest(model.read_bytes())
    model.write_text('{"format": 1, "imports": {}, "snapshot": {"elements": 3}}\n')
    edit(state, recorded, text_digest(model.read_bytes()))
    assert run().in_step


def test_state_of_a_newer_program_is_refused(project: Path) -> None:
    run()
    edit(project / ".urdfsync/robots/ladder.toml", "revision = 1", "revision = 2")
    assert "a newer urdfsync built robot `ladder`" in failure()


def test_state_can_not_reach_files_elsewhere(project: Path, tmp_path: Path) -> None:
    run()
    victim = tmp_path / "victim.txt"
    victim.write_text("precious")
    entry = f'[files."../../../victim.txt"]\nowner = "x"\nrole = "model"\nbase = "{files.digest(b"precious")}"\n'
    path = project / ".urdfsync/robots/ladder.toml"
    path.write_text(path.read_text() + entry)
    run(full=True)
    assert victim.read_text() == "precious"


def test_one_broken_robot_does_not_stop_the_others(project: Path) -> None:
    (project / "broken.json").write_text("{")
    with (project / "urdfsync.toml").open("a") as file:
        file.write('[robots.broken]\nsource = "broken.json"\npackage = "Broken"\ndomain = "rcnetwork"\n')
        file.write('[robots.other]\nsource = "ladder.json"\npackage = "Other"\ndomain = "rcnetwork"\n')
    results = run_all()
    assert [(result.robot, result.failed) for result in results] == [
        ("ladder", False),
        ("broken", True),
        ("other", False),
    ]
    assert exit_code(results) is Exit.ERROR
    assert (project / "modelica/Other/package.mo").exists()
    assert not (project / "modelica/Broken").exists()


# Imports


def test_a_dependency_that_was_never_found_is_left_out(project: Path) -> None:
    (project / "step.csv").unlink()
    result = run()
    assert [str(found) for found in result.diagnostics] == [
        "ladder.json:3: warning: table `step.csv` not found; left out; "
        "add the folder that holds it to `package_paths` [table-not-found]"
    ]
    assert not (project / LADDER / "Resources").exists()
    assert "SignalVoltage" not in (project / LADDER / "Ladder.mo").read_text()
    assert run().in_step
    (project / "step.csv").write_text("0,1\n")
    assert kinds(run()) == {"Resources/step.txt": Kind.CREATE, "Ladder.mo": Kind.UPDATE}


def test_the_copy_serves_where_a_dependency_cant_be_found(project: Path, snapshot_of: Snapshot) -> None:
    run()
    before = snapshot_of(project / LADDER)
    (project / "step.csv").unlink()
    assert run().in_step
    for request in ({"full": True}, {"full": True, "dry": True}):
        result = run(**request)
        assert [found.code for found in result.diagnostics] == ["table-not-found-kept"]
        assert result.in_step
    assert snapshot_of(project / LADDER) == before
    edit(project / "ladder.json", '"ohm": 100', '"ohm": 120')
    assert kinds(run()) == {"Elements/R1Parameters.mo": Kind.UPDATE}


def test_the_copy_serves_in_another_package(project: Path) -> None:
    run()
    (project / "step.csv").unlink()
    configure(project, package='"Filter"')
    run()
    assert (project / "modelica/Filter/Resources/step.txt").exists()
    assert not (project / LADDER).exists()


def test_a_copy_whose_facts_are_lost_is_not_thrown_away(project: Path) -> None:
    run()
    (project / "step.csv").unlink()
    (project / ".urdfsync/robots/ladder.json").unlink()
    assert "what is recorded of its imported copy is lost; restore `.urdfsync/robots`" in failure()
    assert (project / LADDER / "Resources/step.txt").exists()


def test_an_edited_copy_is_kept_and_conflicts_with_a_new_source(project: Path) -> None:
    run()
    copy = project / LADDER / "Resources/step.txt"
    original = copy.read_bytes()
    copy.write_bytes(b"mine")
    assert kinds(run(full=True)) == {"Resources/step.txt": Kind.KEEP}
    edit(project / "step.csv", "0.1,5", "0.1,7")
    assert kinds(run()) == {"Resources/step.txt": Kind.CONFLICT}
    assert copy.read_bytes() == b"mine"
    (project / "step.csv").unlink()
    assert kinds(run()) == {"Resources/step.txt": Kind.CONFLICT}
    copy.write_bytes(original)
    assert exit_code([run()]) is Exit.IN_STEP


def test_an_older_copy_serves_until_its_source_is_back(project: Path) -> None:
    run()
    signal, copy = project / "step.csv", project / LADDER / "Resources/step.txt"
    original = copy.read_bytes()
    copy.write_bytes(b"mine")
    edit(signal, "0.1,5", "0.1,7")
    assert kinds(run()) == {"Resources/step.txt": Kind.CONFLICT}
    content = signal.read_bytes()
    signal.unlink()
    copy.write_bytes(original)
    for request in ({}, {}, {"full": True}):
        result = run(**request)
        assert result.in_step
        assert copy.read_bytes() == original
    signal.write_bytes(content)
    assert kinds(run()) == {"Resources/step.txt": Kind.UPDATE}
    assert "0.1 7.0" in copy.read_text()
    assert run().in_step


def test_a_copy_that_is_deleted_in_the_midst_of_a_build(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run()
    edit(project / "ladder.json", '"ohm": 100', '"ohm": 120')
    copy, bring_in = project / LADDER / "Resources/step.txt", imports.bring_in

    def and_then_it_is_gone(*arguments: Any) -> imports.Imported:
        found = bring_in(*arguments)
        copy.unlink()
        return found

    with monkeypatch.context() as patch:
        patch.setattr(imports, "bring_in", and_then_it_is_gone)
        words = "it changed while urdfsync looked at it; build again [restless]"
        assert failure() == f"{copy.relative_to(project)}: error: {words}"
    assert kinds(run()) == {"Resources/step.txt": Kind.RESTORE, "Elements/R1Parameters.mo": Kind.UPDATE}


def test_package_paths_are_searched(project: Path, tmp_path: Path) -> None:
    (project / "step.csv").rename(tmp_path / "step.csv")
    assert run(package_paths=(tmp_path,), dry=True).diagnostics == ()
    configure(project, package_paths=f'["{tmp_path.as_posix()}"]')
    assert run().diagnostics == ()
