"""The icons of the library."""

from __future__ import annotations

from pathlib import Path

import icons

SHOWN = [name for name in icons.classes() if icons.icon(name).graphics]
COMPONENTS = [name for name in icons.classes() if name.startswith("UrdfSync.Icons.") and not name.endswith("Package")]
SHAPES = [f"UrdfSync.Visualizers.{shape}" for shape in ("Box", "Cylinder", "Capsule", "Sphere", "Mesh")]
REACH = {"Text": 60}
"""How far graphics may go beyond the extent of their icon; all but texts stay inside."""


def outside(name: str) -> list[str]:
    """Graphics of a class that go beyond their reach."""
    shown = icons.icon(name)
    (left, bottom), (right, top) = shown.extent
    return [
        f"{graphic.name} at {(x, y)}"
        for graphic in shown.graphics
        for x, y in icons.corners(graphic)
        if max(left - x, x - right, bottom - y, y - top) > REACH.get(graphic.name, 0) + 1e-9
    ]


def crossed(name: str, library: Path = icons.LIBRARY) -> list[str]:
    """Texts of a class that lie where the lines to its connectors leave the icon."""
    shown = icons.icon(name, library)
    return [
        f"{graphic.get('textString')} at {middle}"
        for graphic in shown.graphics
        for middle in [connector.middle for connector in shown.connectors]
        if graphic.name == "Text" and lies_outside(icons.corners(graphic), middle)
    ]


def lies_outside(corners: list[icons.Point], connector: icons.Point) -> bool:
    """Whether a rectangle is met on the straight way out of the icon from a connector at its border."""
    for along, across in ((0, 1), (1, 0)):
        here, there = connector[along], [corner[along] for corner in corners]
        beside = [corner[across] for corner in corners]
        if abs(here) >= 90 and min(beside) < connector[across] < max(beside) and max(here * x for x in there) > here**2:
            return True
    return False


def test_graphics_stay_inside_their_icon() -> None:
    assert {name: found for name in SHOWN if (found := outside(name))} == {}


def test_icons_of_components_show_the_name_in_blue() -> None:
    for name in COMPONENTS:
        texts = [graphic for graphic in icons.icon(name).graphics if graphic.get("textString") == "%name"]
        assert [graphic.get("textColor") for graphic in texts] == [[0, 0, 255]], name


def test_links_and_joints_leave_room_for_a_text_below() -> None:
    for name in (name for name in COMPONENTS if name.endswith(("Link", "Joint"))):
        pictures = [graphic for graphic in icons.icon(name).graphics if graphic.name != "Text"]
        assert min(y for graphic in pictures for _, y in icons.corners(graphic)) >= -60, name


def test_no_line_to_a_connector_crosses_a_text() -> None:
    assert {name: found for name in SHOWN if (found := crossed(name))} == {}


def test_a_text_above_a_connector_at_the_top_is_crossed(tmp_path: Path) -> None:
    library = tmp_path / "UrdfSync"
    library.mkdir()
    (library / "X.mo").write_text(
        "within UrdfSync;\nmodel X\n"
        '  Modelica.Mechanics.Rotational.Interfaces.Flange_a axis\n    "Drive"\n'
        "    annotation (Placement(transformation(extent={{-10, 90}, {10, 110}})));\n"
        '  annotation (Icon(graphics={Text(extent={{-150, 110}, {150, 150}}, textString="a"), '
        'Text(extent={{-150, -150}, {150, -110}}, textString="b")}));\nend X;\n'
    )
    assert crossed("UrdfSync.X", library) == ["a at (0.0, 100.0)"]


def test_no_two_icons_look_the_same() -> None:
    drawings = [repr(icons.icon(name)) for name in [*COMPONENTS, *SHAPES]]
    assert len(set(drawings)) == len(drawings)
