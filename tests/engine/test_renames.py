"""Renames that the configuration declares: done by the build, refused where they can't be, and told when done."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from support.commands import Execute
from support.networks import edit
from support.urdfs import joint, link, links, robot

from urdfsync.engine.result import Exit

CONFIGURATION = '[robots.dog]\nsource = "dog.urdf"\npackage = "Dog"\n\n[robots.dog.renamed]\n'
MINE = "\n  Real mine = 1;\n\nequation"


def dog(*sides: str) -> str:
    """A trunk with legs that look the same; link and joint of each foot have one name."""
    elements = [link("trunk", 9.0)]
    for side in sides:
        elements += [link(f"{side}_thigh", 2.0), link(f"{side}_foot", 1.0)]
        elements += [joint(f"{side}_hip", "continuous", "trunk", f"{side}_thigh")]
        elements += [joint(f"{side}_foot", "continuous", f"{side}_thigh", f"{side}_foot")]
    return robot(*elements)


@pytest.fixture
def built(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Path:
    """A folder, also the working one, with the package of a dog of two legs."""
    monkeypatch.chdir(tmp_path)
    Path("dog.urdf").write_text(dog("left", "right"))
    Path("urdfsync.toml").write_text(CONFIGURATION)
    execute("build", "-q")
    return tmp_path


def declare(*lines: str) -> None:
    Path("urdfsync.toml").write_text(CONFIGURATION + "\n".join(lines))


def renames(execute: Execute, *arguments: str) -> dict[str, str]:
    """What `diff` calls renamed, by element."""
    (found,) = execute("diff", "--format=json", *arguments, code=Exit.OUT_OF_STEP).json["results"]
    changes = found["result"]["changes"]["changes"]
    return {" ".join(one["path"]): one["new"] for one in changes if one["kind"] == "renamed"}


LEGS = {
    f"{kind} {old}_{part}": f"{new}_{part}"
    for old, new in {"left": "l", "right": "r"}.items()
    for kind, part in (("link", "thigh"), ("link", "foot"), ("joint", "hip"), ("joint", "foot"))
}


def test_one_declared_joint_tells_two_legs_apart(built: Path, execute: Execute) -> None:
    """All else of both legs follows from it, edits move, and then the line is no longer needed."""
    Path("old.urdf").write_text(Path("dog.urdf").read_text())
    edit("modelica/Dog/Links/Left_thigh.mo", "\nequation", MINE)
    Path("dog.urdf").write_text(dog("l", "r"))
    assert renames(execute) == {}
    declare('left_hip = "l_hip"')
    assert renames(execute) == renames(execute, "--against", "old.urdf") == LEGS
    execute("build")
    assert "Real mine" in Path("modelica/Dog/Links/L_thigh.mo").read_text()
    assert not Path("modelica/Dog/Links/Left_thigh.mo").exists()
    note = (
        "urdfsync.toml:6: note: robot `dog`: the last build has `l_hip` already; take `left_hip` out of `renamed` "
        "[rename-done]"
    )
    for command in ("build", "status"):
        assert note in execute(command, "--verbose").words


def test_a_name_is_that_of_the_link_and_of_the_joint(built: Path, execute: Execute) -> None:
    """Where both are gone, and both have the new name."""
    new = dog("left", "right").replace('"left_foot"', '"paw"').replace('"left_thigh"', '"limb"').replace("2.0", "3.0")
    Path("dog.urdf").write_text(new.replace('"left_hip"', '"hip"').replace('"0.1 -0.2 0.3"', '"0 0 1"'))
    assert renames(execute) == {}
    declare('left_foot = "paw"', 'left_thigh = "limb"')
    assert renames(execute) == {
        "link left_foot": "paw",
        "joint left_foot": "paw",
        "link left_thigh": "limb",
        "joint left_hip": "hip",
    }


WRONG = {
    ('left_hip = "left_hip"',): "6: error: robot `dog`: `left_hip` can't be renamed to `left_hip`: "
    "both names are equal; correct it, or take it out",
    ('left_hip = "l_hop"',): "6: error: robot `dog`: `left_hip` can't be renamed to `l_hop`: "
    "the source has no `l_hop`; did you mean `l_hip`?",
    ('left_hop = "l_hip"',): "6: error: robot `dog`: `left_hop` can't be renamed to `l_hip`: "
    "the last build had no joint `left_hop`; did you mean `left_hip`?",
    ('left_hip = "l_thigh"',): "6: error: robot `dog`: `left_hip` can't be renamed to `l_thigh`: "
    "the last build had no link `left_hip`; did you mean `left_thigh`?",
    ('left_hip = "l_hip"', 'left_foot = "l_hip"'): "7: error: robot `dog`: both `left_hip` and `left_foot` are "
    "renamed to `l_hip`; take one entry out",
}


@pytest.mark.parametrize(("lines", "message"), WRONG.items())
def test_a_rename_that_cannot_be_is_refused_with_its_line(
    built: Path, execute: Execute, lines: tuple[str, ...], message: str
) -> None:
    """No command goes on with it."""
    Path("dog.urdf").write_text(dog("l", "right"))
    declare(*lines)
    for command in ("build", "diff", "status"):
        printed = execute(command, code=Exit.ERROR)
        assert f"urdfsync.toml:{message} [wrong-rename]" in printed.words
    assert Path("modelica/Dog/Links/Left_thigh.mo").exists()


def test_without_a_last_build_only_the_source_counts(built: Path, execute: Execute) -> None:
    """A package that is built for the first time has nothing that could be renamed."""
    for folder in (".urdfsync", "modelica"):
        shutil.rmtree(folder)
    declare('left_hap = "left_hip"')
    assert "rename" not in execute("build").err
    declare('trunk = "left_thingh"')
    assert "the source has no `left_thingh`; did you mean `left_thigh`?" in execute("build", code=Exit.ERROR).words


def test_what_was_declared_while_a_conflict_is_open_can_be_taken_back(built: Path, execute: Execute) -> None:
    """The wrong leg is declared first: nothing of that is recorded."""
    edit("modelica/Dog/Links/Left_thigh.mo", "\nequation", MINE)
    edit("modelica/Dog/Links/TrunkParameters.mo", "9", "8")
    Path("dog.urdf").write_text(dog("l", "r").replace("9.0", "7.0"))
    declare('left_hip = "r_hip"')
    execute("build", "-q", code=Exit.CONFLICT)
    assert renames(execute)["link left_thigh"] == "r_thigh"
    declare()
    assert renames(execute) == {}
    declare('left_hip = "l_hip"')
    assert renames(execute) == LEGS


def test_names_that_are_exchanged_while_a_conflict_is_open_are_recorded_at_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute
) -> None:
    """One of two equal parts gives its name away: the next build, which finds nothing new, records nothing new."""

    def export(mass: float, **ends: str) -> None:
        """A hub with two equal fingers; each joint with its parent and its child."""
        joints = [
            joint(name, "revolute", *pair.split(), axis="0 0 1")
            if name in ("l", "r")
            else joint(name, "continuous", *pair.split(), axis="0 1 0", xyz="0 0 0", rpy="0 0 0")
            for name, pair in ends.items()
        ]
        names = {child: 1.0 for pair in ends.values() for child in pair.split()}
        Path("arm.urdf").write_text(
            robot(*links(**names | {"base": mass, "hub": 2.0, "left": 3.0, "right": 3.0}), *joints)
        )

    monkeypatch.chdir(tmp_path)
    export(9.0, hub_joint="base hub", l="hub left", r="hub right")
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n')
    execute("build", "-q")
    edit("modelica/Arm/Links/BaseParameters.mo", "mass = 9", "mass = 9.5")
    export(8.0, hub_joint="base hub", other_joint="hub left", r="hub right")
    execute("build", "-q", code=Exit.CONFLICT)
    export(8.0, post_joint="base post", hub_joint="post hub", l="hub right", r="hub left")
    execute("build", "-q", code=Exit.CONFLICT)
    record = Path(".urdfsync/robots/arm.state").read_text()
    shutil.rmtree(".urdfsync/deps")
    execute("build", "-q", code=Exit.CONFLICT)
    assert Path(".urdfsync/robots/arm.state").read_text() == record


def test_an_edit_stays_where_only_names_of_other_parts_changed(built: Path, execute: Execute) -> None:
    """The joint keeps its name; its link has a new one, which the description and the documentation tell."""
    edit("modelica/Dog/Joints/Left_hip.mo", "\nequation", MINE)
    Path("dog.urdf").write_text(Path("dog.urdf").read_text().replace('"trunk"', '"torso"'))
    result = execute("build")
    text = Path("modelica/Dog/Joints/Left_hip.mo").read_text()
    assert "merge modelica/Dog/Joints/Left_hip.mo link trunk; merged with your edits" in result.words
    assert "Real mine" in text
    assert "torso" in text
    assert "trunk" not in text
    execute("build", "--check")


def test_an_edit_of_the_description_conflicts_with_a_new_name_in_it(built: Path, execute: Execute) -> None:
    edit("modelica/Dog/Joints/Left_hip.mo", "from link", "mounted on link")
    Path("dog.urdf").write_text(Path("dog.urdf").read_text().replace('"trunk"', '"torso"'))
    result = execute("build", code=Exit.CONFLICT)
    assert "conflict modelica/Dog/Joints/Left_hip.mo" in result.words
    assert "mounted on link" in Path("modelica/Dog/Joints/Left_hip.mo").read_text()


def test_a_changed_mass_loads_no_numpy(built: Path) -> None:
    """It takes as long as the rest of such a build."""
    edit("dog.urdf", 'mass value="9.0"', 'mass value="8.0"')
    code = "import sys; from urdfsync.commands import cli; cli.main(['build']); print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "1 file written" in done.stdout
    assert not {"numpy", "yourdfpy", "deepdiff"} & {*done.stdout.split()}
