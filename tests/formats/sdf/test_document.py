"""An SDF and the files that it includes."""

from __future__ import annotations

import pytest
from support.sdfs import FOLDER, SOURCE, arm, hinge, joint, link, model, problem, read, sdf, urdf

from urdfsync.formats.sdf.document import SdfDocument
from urdfsync.formats.sdf.frames import Frames
from urdfsync.formats.translation.files import Files, TranslationError

HAND = sdf(
    '<model name="hand"><pose>0 0 9 0 0 0</pose><link name="palm"/>\n<link name="tip"/>'
    + hinge("h", "palm", "tip")
    + "</model>"
)
CONFIG = (
    '<model><name>Hand</name><sdf version="1.4">old.sdf</sdf><sdf version="1.9">hand.sdf</sdf>'
    '<sdf version="9.9">new.sdf</sdf></model>'
)


def including(inside: str, parent: str = "hand::palm") -> str:
    held = hinge("held", "base", parent, "", "fixed")
    return model(f'<link name="base"/>\n<include>{inside}</include>{held}{hinge("turn", "world", "base")}')


@pytest.mark.parametrize(
    "uri", ["hand.sdf", "file://hand.sdf", f"file://{FOLDER}/hand.sdf", "hand", "file://hand", "../arm/hand"]
)
def test_an_include_is_a_nested_model(uri: str) -> None:
    """A folder has a `model.config`, which names the file of the newest version that urdfsync reads."""
    place = "hand/hand.sdf" if uri.endswith("hand") else "hand.sdf"
    robot = read(including(f"<uri>{uri}</uri>"), {place: HAND, "hand/model.config": CONFIG})
    assert [each.name for each in robot.links] == ["world", "base", "hand::palm", "hand::tip"]
    assert joint(robot, "held").origin.xyz == (0, 0, 9)


def test_an_include_changes_its_model() -> None:
    inside = "<uri>hand.sdf</uri><name>grip</name><pose>0 0 2 0 0 0</pose><placement_frame>tip</placement_frame>"
    hand = HAND.replace('<link name="tip"/>', '<link name="tip"><pose>0 0 0.5 0 0 0</pose></link>')
    robot = read(including(inside, "grip::palm"), {"hand.sdf": hand})
    assert joint(robot, "held").origin.xyz == (0, 0, 1.5)
    assert joint(robot, "grip::h").child == "grip::tip"


def test_a_merged_include_has_its_names_in_the_model_around_it() -> None:
    text = including("<uri>hand.sdf</uri><pose>0 0 2 0 0 0</pose>", "palm").replace(
        "<include>", '<include merge="true">'
    )
    robot = read(text, {"hand.sdf": HAND})
    assert [each.name for each in robot.joints] == ["turn", "held", "h"]
    assert joint(robot, "held").origin.xyz == (0, 0, 2)


def test_each_element_has_a_place() -> None:
    frames = Frames(
        SdfDocument(
            SOURCE,
            files := Files(
                {
                    SOURCE: including("<uri>hand.sdf</uri>").encode(),
                    f"{FOLDER}/hand.sdf": HAND.encode(),
                },
                [FOLDER],
            ),
        )
    )
    tip = frames.look_up(frames.world.models[0], "hand::tip", frames.world.element)
    assert frames.document.places[tip.element] == (f"{FOLDER}/hand.sdf", 3)
    assert {name.removeprefix(FOLDER) for name in files.hashes} == {"/arm.sdf", "/hand.sdf"}
    assert None not in files.hashes.values()


def test_comments_are_those_of_gazebos_parser() -> None:
    """Its examples begin with comments on command lines; XML allows no `--` in them."""
    text = f"<!-- gz sim\n--verbose -->\n<?xml version='1.0'?>{arm('<inertial><mass>x</mass></inertial>')}"
    assert problem(text).startswith("arm.sdf:4: <mass> 'x' is not a decimal number")


def test_a_missing_file_is_recorded() -> None:
    files = Files({SOURCE: including("<uri>hand.sdf</uri>").encode()}, [FOLDER])
    with pytest.raises(TranslationError):
        Frames(SdfDocument(SOURCE, files))
    assert files.hashes[f"{FOLDER}/hand.sdf"] is None


def test_a_mesh_of_an_included_file_counts_from_its_folder() -> None:
    mesh = '<link name="palm"><visual name="v"><geometry><mesh><uri>m/a.stl</uri></mesh></geometry></visual></link>'
    hand = HAND.replace('<link name="palm"/>', mesh)
    text, _ = urdf(including("<uri>parts/hand.sdf</uri>"), {"parts/hand.sdf": hand})
    assert 'filename="parts/m/a.stl"' in text


def test_scenery_may_be_missing() -> None:
    ground = "<include><uri>model://ground_plane_of_nowhere</uri></include>"
    robot = arm()[arm().index("<model") : -6]
    assert link(read(sdf(f'<world name="w">{ground}{robot}</world>')), "part")
    told = problem(sdf(f'<world name="w">\n{ground}</world>'))
    assert told.startswith(
        "arm.sdf:3: there is no folder 'ground_plane_of_nowhere' for model://ground_plane_of_nowhere"
    )


def test_a_fault_in_scenery_is_told() -> None:
    robot = arm()[arm().index("<model") : -6]
    text = sdf(f'<world name="w"><include><uri>a.sdf</uri></include>{robot}</world>')
    assert problem(text, {"a.sdf": "<sdf>\n<model></sdf>"}).startswith("a.sdf:2: this is not well-formed XML")


@pytest.mark.parametrize(
    ("text", "files", "told"),
    [
        ("<sdf>\n</sdf>", {}, 'arm.sdf:1: <sdf> has no version; write <sdf version="1.9">'),
        ('<sdf version="one"/>', {}, "arm.sdf:1: version='one' is no version of SDF"),
        ('<sdf version="1.13"/>', {}, "arm.sdf:1: the file is of SDF 1.13, and urdfsync reads 1.3 to 1.12; install a"),
        (
            '<sdf version="1.2"/>',
            {},
            "arm.sdf:1: the file is of SDF 1.2, and urdfsync reads 1.3 to 1.12; convert",
        ),
        (arm()[:200], {}, "arm.sdf:2: this is not well-formed XML: unclosed token"),
        (including(""), {}, "arm.sdf:3: <include> has no <uri>"),
        (including("<uri>hand.sdf</uri>"), {}, "arm.sdf:3: hand.sdf can't be read: No such file or directory; put"),
        (including("<uri>hand</uri>"), {}, "arm.sdf:3: hand/model.config can't be read: No such file"),
        (including("<uri>hand</uri>"), {"hand/model.config": "<model/>"}, "hand/model.config:1: it names no <sdf>"),
        (
            including("<uri>https://a.org/hand</uri>"),
            {},
            "arm.sdf:3: https://a.org/hand is not on this machine",
        ),
        (including("<uri>arm.sdf</uri>"), {}, "arm.sdf:3: arm.sdf includes itself; take one <include> out"),
        (including("<uri>../other/a.sdf</uri>"), {}, "arm.sdf:3: the included file /robots/other/a.sdf is outside"),
        (including("<uri>/etc/a.sdf</uri>"), {}, "arm.sdf:3: the included file /etc/a.sdf is outside of the project"),
        (
            including("<uri>hand</uri>"),
            {"hand/model.config": '<model><sdf version="1.5">../../a.sdf</sdf></model>'},
            "arm.sdf:3: the included file /robots/a.sdf is outside of the project",
        ),
        (
            including("<uri>hand.sdf</uri>"),
            {"hand.sdf": sdf('<model name="hand">\n<include><uri>hand.sdf</uri></include></model>')},
            "hand.sdf:3: hand.sdf includes itself",
        ),
        (including("<uri>a.urdf</uri>"), {"a.urdf": "<robot/>"}, "a.urdf:1: the root element is <robot> and not <sdf>"),
        (including("<uri>a.sdf</uri>"), {"a.sdf": sdf("")}, "arm.sdf:3: a.sdf has 0 models, and <include> needs one"),
        ('<!DOCTYPE m [<!ENTITY a "b">]>\n<sdf/>', {}, "arm.sdf:1: the file declares XML entities"),
    ],
)
def test_a_fault_has_a_line(text: str, files: dict[str, str], told: str) -> None:
    assert problem(text, files).startswith(told)


@pytest.mark.slow
def test_includes_of_includes_have_a_limit() -> None:
    """Twenty files that include the next one twice would be a million models."""
    files = {
        f"m{number}.sdf": sdf(
            '<model name="m"><link name="l"/>'
            + "".join(f"<include><name>{name}</name><uri>m{number + 1}.sdf</uri></include>" for name in "ab")
            + "</model>"
        )
        for number in range(20)
    }
    files["m20.sdf"] = sdf('<model name="m"><link name="l"/></model>')
    assert "the model has more than 20,000 elements with a name" in problem(including("<uri>m0.sdf</uri>"), files)
