"""Pages in a real Chromium: drawn, moved as Pinocchio says, with one selection everywhere; they run nothing else."""

from __future__ import annotations

import math
import shutil
from collections.abc import Callable
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np
import pytest
from support.browser import NEEDS_CHROMIUM, Page
from support.corpus import REPOSITORY

from urdfsync.analysis.checks.results import CheckResult, Curve
from urdfsync.analysis.pages.content import gather
from urdfsync.analysis.pages.page import page as page_of
from urdfsync.analysis.simulation.results import JointResult, PassedLimit, Range, SimulateResult
from urdfsync.commands import cli
from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.domain.experiment import Quantity
from urdfsync.engine.options import BuildOptions
from urdfsync.project import config

pytestmark = [NEEDS_CHROMIUM, pytest.mark.slow]
FOUR_BAR = REPOSITORY / "modelica/UrdfSync/Resources/robots/four_bar"
CLOSED = """
[robots.bar]
source = "four_bar.urdf"
package = "Bar"
start = {{ crank_pivot = 1.2, crank_pin = -0.9, rocker_pivot = 1.2 }}
[[robots.bar.loops]]
name = "rocker_pin"
kind = "ball"
frames = [{{ link = "coupler", xyz = [{length}, 0, -0.025] }}, {{ link = "rocker", xyz = [0.4, 0, 0] }}]
"""
MOVED = "(move('joint crank_pivot', {}), Object.fromEntries(page.positions))"
Report = Callable[..., Path]
READY = "page.complete.then(() => true)"
PAINTED = "page.now.bodies.get({!r}).layers.visual[0].material.{}.getHex()"


def opened(chromium: Page, file: Path, **options: object) -> Page:
    chromium.problems.clear()
    chromium.open(file, ready=READY, **options)  # type: ignore[arg-type]
    assert chromium.run("element('trouble').hidden"), chromium.run("element('trouble').textContent")
    return chromium


def replace(file: Path, old: str, new: str) -> None:
    text = file.read_text("utf-8")
    assert old in text
    file.write_text(text.replace(old, new, 1), "utf-8")


def test_a_four_bar_stays_closed_under_its_slider_and_stops_where_it_would_open(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, report: Report, chromium: Page
) -> None:
    """The rocker's end is where circles about its pivot and about the crank's end meet."""
    shutil.copytree(FOUR_BAR, tmp_path, dirs_exist_ok=True)
    monkeypatch.chdir(tmp_path)
    Path("urdfsync.toml").write_text(CLOSED.format(length=0.6), "utf-8")
    page = opened(chromium, report())
    assert page.run("[...document.querySelectorAll('#axes input[type=range]')].length") == 1
    for angle in (2.0, -1.5, 3.1):
        rocker = page.run(MOVED.format(angle))["joint rocker_pivot"]
        x, y = 0.2 * math.cos(angle) - 0.5, 0.2 * math.sin(angle)
        distance = math.hypot(x, y)
        expected = math.atan2(y, x) - math.acos((distance**2 + 0.4**2 - 0.6**2) / (2 * 0.4 * distance))
        assert math.remainder(rocker - expected, math.tau) == pytest.approx(0, abs=1e-8)
    page.run("pose('Random')")
    assert page.run("gapsOf(page.now).every((gap) => Math.abs(gap) < 1e-9)")
    for time in (5, 10):
        page.run(f"page.player.seek({time})")
        assert page.run("gapsOf(page.now).every((gap) => Math.abs(gap) < 1e-9)")
    assert page.run("page.positions.get('joint crank_pivot')") == pytest.approx(1.2)
    x, y = place_of(page, "link coupler")
    page.drag((x, y), (x, y - 8), (x, y - 30))  # the crank turns
    assert abs(page.run("page.positions.get('joint crank_pivot')") - 1.2) > 0.02
    assert page.run("gapsOf(page.now).every((gap) => Math.abs(gap) < 1e-9)")
    x, y = place_of(page, "link rocker")
    page.drag((x, y), (x, y + 30))
    assert page.run("element('told').textContent") == "Loops move rocker: drag another link."
    page.run("select('loop rocker_pin')")
    assert "ball" in page.run("element('details').textContent")
    Path("urdfsync.toml").write_text(CLOSED.format(length=0.25), "utf-8")  # the crank locks at 2.29 rad
    page = opened(chromium, report())
    assert 2.2 < page.run(MOVED.format(3.0))["joint crank_pivot"] < 2.3
    assert page.run("gapsOf(page.now).every((gap) => Math.abs(gap) < 1e-9)")


def assert_poses_are_pinocchios(page: Page, urdf: Path) -> None:
    pinocchio = pytest.importorskip("pinocchio")
    model = pinocchio.buildModelFromUrdf(str(urdf))
    said, positions = page.run("Object.fromEntries(page.positions)"), pinocchio.neutral(model)
    for joint, name in enumerate(model.names):
        if joint and f"joint {name}" in said:
            positions[model.joints[joint].idx_q] = said[f"joint {name}"]
    placed = model.createData()
    pinocchio.framesForwardKinematics(model, placed, positions)
    poses = page.run("Object.fromEntries(data.now.bodies.map(({ element }) => [element, page.pose(element)]))")
    for element, pose in poses.items():
        expected = placed.oMf[model.getFrameId(element.removeprefix("link "))].homogeneous
        assert np.abs(np.array(pose).reshape(4, 4).T - expected).max() < 1e-6, element


def test_sliders_move_the_arm_as_pinocchio_does(arm: Path, report: Report, chromium: Page) -> None:
    page = opened(chromium, report())
    # the last digit of a slider is its own: what it says is what counts
    said = page.run(
        """(() => {
          const wanted = { turret: 0.7, shoulder: -0.4, elbow: -1.1, forearm_roll: 2, wrist_pitch: 0.9 };
          wanted.gripper_stroke = 0.02;
          for (const [name, position] of Object.entries(wanted)) {
            const slider = document.querySelector(`[data-axis="joint ${name}"] input[type=range]`);
            slider.value = position;
            slider.dispatchEvent(new Event("input"));
          }
          return Object.fromEntries(page.positions);
        })()"""
    )
    assert math.isclose(said["joint finger_coupling"], said["joint gripper_stroke"], abs_tol=1e-12)  # a follower
    assert_poses_are_pinocchios(page, arm)
    assert page.problems == []


def test_a_click_selects_in_picture_tree_diagram_and_details(arm: Path, report: Report, chromium: Page) -> None:
    page = opened(chromium, report())
    glow = PAINTED.format("link forearm", "emissive")
    assert page.run(glow) == 0
    page.run("element('tab-tree').click(), document.querySelector('[data-link=\"link forearm\"]').click()")
    assert page.run(glow) != 0
    assert page.run("document.querySelector('[aria-selected=true][data-link]').dataset.link") == "link forearm"
    marked = "element('drawing').shadowRoot.querySelector('[data-selected]')?.dataset.selected"
    assert page.run(marked) == "link forearm"
    details = page.run("element('details').textContent")
    assert "4.2 kg" in details
    assert "Links/Forearm.mo" in details
    page.run("select(null)")
    assert page.run(glow) == 0
    # a click into the picture, where the link is drawn
    page.click(*place_of(page, "link upper_arm"))
    assert page.run("page.selected") == "link upper_arm"
    page.run(
        "element('drawing').shadowRoot.querySelectorAll('g > title').forEach((title) => {"
        " if (title.textContent === 'elbow') title.parentNode.dispatchEvent(new MouseEvent('click')); })"
    )
    assert page.run("page.selected") == "joint elbow"
    assert page.problems == []


SWEPT = ("turret", "shoulder", "elbow", "forearm_roll", "wrist_pitch", "flange_roll")
"""Joints that Test moves by 1 rad, which their limits and speeds allow."""
DISTANCE = """{{
  const {{ point, element: link }} = hitAt(placeOf({{ clientX: {x}, clientY: {y} }}), page.now);
  const {{ matrixWorld }} = page.now.bodies.get(link).group, local = point.applyMatrix4(matrixWorld.clone().invert());
  var distance = (turn) => {{ // between the pointer at the end and the place that it took, if the shoulder turned more
    const before = page.positions.get("joint shoulder"), pointer = placeOf({{ clientX: {to_x}, clientY: {to_y} }});
    page.now.move(new Map([["joint shoulder", before + turn]]));
    const [left, top] = project(local.clone().applyMatrix4(matrixWorld));
    page.now.move(new Map([["joint shoulder", before]]));
    return Math.hypot(left - pointer[0], top - pointer[1]);
  }};
}}"""
HOME = """<robot name="six_axis_arm"><group_state name="home" group="arm"><joint name="elbow" value="-0.5"/>
<joint name="tail" value="1"/></group_state>
<group_state name="constructor" group="arm"><joint name="elbow" value="0.25"/></group_state></robot>"""


def test_the_sweep_of_test_plays_as_pinocchio_says(arm: Path, report: Report, chromium: Page) -> None:
    page = opened(chromium, report())
    for time in (2.5, 5.0, 8.0):
        page.run(f"page.player.seek({time})")
        said = page.run("Object.fromEntries(page.positions)")
        share = (1 - math.cos(math.tau * time / 10)) / 2
        assert [said[f"joint {name}"] for name in SWEPT] == pytest.approx([share] * len(SWEPT))
        assert said["joint gripper_stroke"] == pytest.approx(0.9 * 0.035 * share)
        assert_poses_are_pinocchios(page, arm)
    page.run("element('play').click()")
    assert page.run("page.player.isPlaying") is True
    page.run("move('joint elbow', -0.25)")
    assert page.run("[page.player.isPlaying, page.positions.get('joint elbow')]") == [False, -0.25]
    assert page.problems == []


def place_of(page: Page, link: str) -> tuple[float, float]:
    """Return where the middle of a link's first shape is in the window."""
    box = f"new THREE.Box3().setFromObject(page.now.bodies.get({link!r}).layers.visual[0])"
    x, y = page.run(f"project({box}.getCenter(new THREE.Vector3()))")[:2]
    left, top = page.run("(({ left, top }) => [left, top])(element('view').getBoundingClientRect())")
    return left + x, top + y


def test_a_hand_moves_the_arm_by_dragging_typing_and_poses(arm: Path, report: Report, chromium: Page) -> None:
    Path("arm.srdf").write_text(HOME)
    page = opened(chromium, report())
    assert "arm.srdf: its poses name 1 joint that this robot lacks, such as tail" in page.run(
        "element('left-out').textContent"
    )
    positions = "[...page.positions.values()]"
    before, azimuth = page.run(positions), page.run("stage.orbit.azimuth")
    # a link follows the pointer
    x, y = place_of(page, "link upper_arm")
    page.run(DISTANCE.format(x=x, y=y, to_x=x + 60, to_y=y + 10))
    page.drag((x, y), (x + 20, y), (x + 60, y + 10))
    moved = page.run(positions)
    assert len([1 for one, other in zip(before, moved, strict=True) if one != other]) == 1
    assert abs(page.run("page.positions.get('joint shoulder')")) > 0.1
    assert_poses_are_pinocchios(page, arm)
    assert page.run("element('told').textContent").startswith("shoulder ")
    less, least, more = page.run("[-0.01, 0, 0.01].map(distance)")
    assert least < min(less, more)  # no turn brings the place that was taken nearer to the pointer
    assert page.run("stage.orbit.azimuth") == azimuth
    # the background turns the camera
    page.drag((700, 650), (720, 650), (760, 650))
    assert page.run(positions) == moved
    assert page.run("stage.orbit.azimuth") != azimuth
    # poses
    for name, elbow in (("home", -0.5), ("constructor", 0.25)):
        page.run(f"document.querySelector('[data-pose={name}]').click()")
        assert page.run("page.positions.get('joint elbow')") == elbow
    ends = (
        "data.now.hinges.filter(isFree).map((hinge) => [hinge.lower, page.positions.get(hinge.element), hinge.upper])"
    )
    for name in ("Zero", "Middle", "Random"):
        page.run(f"document.querySelector('[data-pose={name}]').click()")
        for low, at, high in page.run(ends):
            assert low <= at <= high
            expected = {"Zero": 0, "Middle": (low + high) / 2, "Random": at if at else None}[name]
            assert at == pytest.approx(expected)
    # angles in degrees
    page.run("element('units').lastChild.click()")
    number = "document.querySelector('[data-axis=\"joint elbow\"] input[type=number]')"
    page.run(f"{number}.value = '-30', {number}.dispatchEvent(new Event('change'))")
    assert page.run("page.positions.get('joint elbow')") == pytest.approx(-math.pi / 6)
    assert page.run("document.querySelector('[data-axis=\"joint elbow\"]').textContent").endswith(
        "° = -0.5236 rad-199.96 °70.015 °"
    )
    page.run("element('units').firstChild.click()")
    # keys, with the focus on a slider and in a number
    for focus in ("range", "number"):
        page.run(f"document.querySelector('[data-axis] input[type={focus}]').focus()")
        for key in "rfn":
            page.press(key)
        assert page.run("page.positions.get('joint elbow')") == 0
        assert page.run("[page.layers.frame, page.layers.label]") == [focus == "range"] * 2
    # names, world axes and ruler
    page.run("toggle('label'), toggle('world'), render(1)")
    assert {"forearm", "x", "y", "z"} <= {*page.run("[...element('labels').children].map((each) => each.textContent)")}
    page.run("toggle('label'), data.findings['joint elbow'] = ['too weak'], doubted.add('link forearm'), paint()")
    assert "!" in page.run("[...element('labels').children].map((each) => each.textContent)")
    page.press("u")
    page.click(*place_of(page, "link base_link"))
    page.click(*place_of(page, "link forearm"))
    length = page.run("page.ruler.way.length()")
    assert 0.5 < length < 1.5
    assert f"{length:.4f} m: x " in page.run("element('told').textContent")
    page.run("move('joint shoulder', 1)")
    assert page.run("page.ruler.way.length()") != pytest.approx(length)  # its ends stay on their links
    page.press("Escape")
    assert page.run("page.ruler.line.visible") is False
    assert page.problems == []


def test_changed_links_have_the_colour_and_the_old_robot_is_there(arm: Path, report: Report, chromium: Page) -> None:
    assert cli.main(["build", "--quiet"]) == 0
    replace(arm, '<mass value="4.2"/>', '<mass value="5"/>')
    replace(arm, '<origin xyz="0 0 0.44"/>', '<origin xyz="0 0 0.5"/>')
    page = opened(chromium, report())
    color = PAINTED.format("link forearm", "color")
    assert page.run("[...element('legend').children].map((each) => each.textContent)") == ["changed", "old place"]
    assert page.run(color) == page.run("themeColor('changed').getHex()")
    assert page.run("[page.now, page.before].map((view) => view.root.visible)") == [True, True]
    # the base is where it was, what hangs on the elbow is not
    shown = "page.before.bodies.get({!r}).layers.visual[0].visible"
    assert [page.run(shown.format(name)) for name in ("link base_link", "link forearm")] == [False, True]
    heights = page.run("[page.now, page.before].map((view) => view.pose('link forearm')[14])")
    assert math.isclose(heights[0] - heights[1], 0.06, abs_tol=1e-12)
    page.run("chooseVersion('now')")
    assert page.run(color) == page.run("page.now.bodies.get('link forearm').layers.visual[0].userData.color.getHex()")
    assert page.run("[page.before.root.visible, element('legend').hidden]") == [False, True]
    assert page.problems == []


def test_a_position_beyond_a_limit_is_told_beside_the_slider_and_in_the_picture(
    arm: Path, report: Report, chromium: Page
) -> None:
    page = opened(chromium, report())
    row = "document.querySelector('[data-axis=\"joint {}\"]')"
    words, told = f"{row.format('elbow')}.textContent", "element('told').textContent"

    def type_(name: str, position: float) -> None:
        number = f"{row.format(name)}.querySelector('[type=number]')"
        page.run(f"({number}.value = '{position}', {number}.dispatchEvent(new Event('change')))")

    type_("elbow", 1.2)
    assert "beyond" not in page.run(words)
    assert "limit" not in page.run(told)
    type_("elbow", 1.3)
    assert "beyond its limit1.222 rad" in page.run(words)
    assert page.run(f"{row.format('elbow')}.querySelector('[aria-invalid=true]') !== null")
    assert page.run(told) == "Beyond the limits: elbow"
    page.run("select('link forearm')")
    assert page.run(told) == "link forearm · Beyond the limits: elbow"
    page.run("pose('Zero')")
    assert page.run(told) == "Pose: Zero"
    # a follower has limits of its own
    type_("gripper_stroke", 0.05)
    assert page.run(told).endswith("Beyond the limits: gripper_stroke, finger_coupling, pinion_coupling")
    assert "beyond its limit" in page.run(f"{row.format('finger_coupling')}.textContent")
    assert page.problems == []


def test_space_plays_wherever_the_focus_is_and_presses_nothing(arm: Path, report: Report, chromium: Page) -> None:
    page = opened(chromium, report())
    places = (
        "#play",
        "[data-pose=Middle]",
        "#tab-tree",
        "summary",
        "[data-axis] .name",
        "#axes input",
        "[role=treeitem]",
    )
    state = "JSON.stringify([[...page.positions], page.selected, element('tree').hidden, element('poses').open])"
    page.run("chooseTab(element('tab-tree'))")
    page.run("page.player.pause = () => {}")
    for place in places:
        page.run(f"chooseTab(element('tab-{'tree' if 'tree' in place else 'axes'}'))")
        before = page.run(state)
        page.run(f"document.querySelector('{place}').focus()")
        page.press(" ")
        assert page.run("page.player.isPlaying"), place
        page.press(" ")
        assert not page.run("page.player.isPlaying"), place
        page.run("page.player.seek(0)")
        assert page.run(state) == before, place
    # a text takes its blanks
    page.run("(chooseTab(element('tab-tree')), element('filter').focus())")
    page.press(" ")
    assert not page.run("page.player.isPlaying")
    assert page.run("element('filter').value") == " "
    assert page.problems == []


def test_a_pose_sets_the_player_back(arm: Path, report: Report, chromium: Page) -> None:
    page = opened(chromium, report())
    page.run("page.player.seek(3)")
    page.press("r")
    assert page.run("[page.player.time, document.querySelector('#player input').value]") == [0, "0"]
    starts = "data.now.hinges.filter(isFree).every((hinge) => page.positions.get(hinge.element) === hinge.start)"
    assert page.run(starts)
    assert page.problems == []


def test_no_table_breaks_a_word(arm: Path, report: Report, chromium: Page) -> None:
    """A word in two lines has two rectangles."""
    page = opened(chromium, report(), width=900)
    words = """[...document.querySelectorAll("td, th")].flatMap((cell) => [...cell.childNodes]
        .filter((node) => node.nodeType === 3).flatMap((node) => [...node.data.matchAll(/\\S+/g)].filter((word) => {
            const range = document.createRange();
            range.setStart(node, word.index);
            range.setEnd(node, word.index + word[0].length);
            return range.getClientRects().length > 1 && !word[0].includes("-");
        }).map(([word]) => word)))"""
    assert page.run(words) == []


def test_the_selection_has_a_colour_of_its_own(arm: Path, report: Report, chromium: Page) -> None:
    assert cli.main(["build", "--quiet"]) == 0
    replace(arm, '<origin xyz="0 0 0.44"/>', '<origin xyz="0 0 0.5"/>')
    page = opened(chromium, report())
    old = page.run("page.before.bodies.get('link wrist').layers.visual[0].material.color.getHex()")
    page.run("select('link forearm')")
    glow = page.run("page.now.bodies.get('link forearm').layers.visual[0].material.emissive.toArray()")
    names = "accent", "changed", "added", "removed", "selected"
    red, green, blue = (page.run(f"themeColor('{name}').toArray()") for name in ("selected", "accent", "selected"))
    assert old == page.run("themeColor('accent').getHex()")
    assert glow == pytest.approx([0.55 * part for part in red])
    assert blue == red != green
    for dark in ("light", "dark"):
        page.run(f"setTheme('{dark}')")
        assert len({page.run(f"themeColor('{name}').getHex()") for name in names}) == len(names)
    frame = "element('drawing').shadowRoot.querySelector('[data-selected]').getAttribute('stroke')"
    assert page.run(frame) == "#c2188b"
    assert page.problems == []


def test_a_simulation_moves_the_robot_and_stands_beside_its_limits(arm: Path, tmp_path: Path, chromium: Page) -> None:
    loaded = config.load(Path("urdfsync.toml"))
    content = gather(loaded, loaded.robots[0], None, BuildOptions(), tmp_path)
    series = {"time": [0.0, 1.0, 2.0], "elbow.phi": [0.0, 0.5, math.nan], "elbow.tau": [0.0, 150.0, -3.0]}
    position = Range("elbow.phi", "rad", 0.0, 0.5, -3.49, 0.6)
    effort = Range("elbow.tau", "N·m", -3.0, 150.0, -130.0, 130.0)
    passed = (PassedLimit("effort", 130.0, 0.9, 20.0, 0.2),)
    warning = Diagnostic(Severity.WARNING, "limit-passed", "effort passes its limit")
    joint = JointResult("joint elbow", "robot", position, None, effort, passed=passed)
    result = SimulateResult("arm", "Arm.ArmTest", 2.0, 1.0, 1e-6, (joint,), series, (warning,), 1.0, is_known=False)
    file = tmp_path / "motion.html"
    file.write_bytes(page_of(content, result))
    page = opened(chromium, file)
    page.run("page.player.seek(0.5)")
    assert page.run("page.now.positions.get('joint elbow')") == 0.25
    assert page.run("document.querySelectorAll('.charts').length") == 1
    assert page.run("document.querySelectorAll('.chart .limit').length") == 2  # lower limits are far
    assert "passed" in page.run("document.querySelector('figcaption.removed').textContent")
    assert "effort passes its limit" in page.run("element('motion').textContent")
    page.run("page.player.seek(1.9), page.player.toggle()")  # real time: the end comes after a tenth of a second
    page.run(
        "new Promise((go) => { const wait = () => page.player.isPlaying ? setTimeout(wait, 20) : go(1); wait(); })"
    )
    assert page.run("page.player.time") == 2
    assert page.problems == []


def test_a_check_is_drawn_beside_its_reference_with_the_error_on_a_log_scale(
    arm: Path, tmp_path: Path, chromium: Page
) -> None:
    loaded = config.load(Path("urdfsync.toml"))
    content = gather(loaded, loaded.robots[0], None, BuildOptions(), tmp_path)
    times, expected = (0.0, 0.2, 0.4, 0.6), (1.0, 2.0, 3.0, 4.0)
    values = ((1.0, 2.0 + 1e-12, 3.0, 4.01),)  # in one line, which has the errors 1e-17, 1e-12, 1e-17 and 1e-2
    curve = Curve(Quantity.EFFORT, "joint elbow", "N·m", times, values, (expected,))
    file = tmp_path / "check.html"
    check = CheckResult("arm", "Arm", curves=(curve,), reference="Pinocchio 3")
    file.write_bytes(page_of(content, check=check))
    page = opened(chromium, file)
    drawn = "[...document.querySelectorAll('#curves .{}')].map((path) => path.getAttribute('d'))"
    (reference,), (curve_, error) = (page.run(drawn.format(kind)) for kind in ("reference", "curve"))
    assert [(text.count("M"), text.count("L")) for text in (reference, curve_, error)] == [(1, 3)] * 3
    heights = [float(point.split(",")[1].removesuffix(" h0")) for point in error.replace("L", "M").split("M")[1:]]
    assert heights[0] == heights[2] > heights[1] > heights[3]
    assert "effort in N·m, 1 … 4, 0 … 0.6 s" in page.run("element('curves').textContent")
    assert "error of effort in N·m, 10^-17 … 10^-2 on a log scale" in page.run("element('curves').textContent")
    page.run("document.querySelector('#curves button').click()")
    assert page.run("page.selected") == "joint elbow"
    assert page.problems == []


PLANAR = """<robot name="cart"><link name="floor"/><link name="cart"/><link name="drone"/>
<link name="eye"><visual><origin xyz="0.5 0 0"/><geometry><sphere radius="0.2"/></geometry></visual></link>
<joint name="look" type="ball"><parent link="drone"/><child link="eye"/></joint>
<joint name="drive" type="planar"><parent link="floor"/><child link="cart"/><origin xyz="0 0 1"/><axis xyz="{0}"/>
</joint><joint name="fly" type="floating"><parent link="cart"/><child link="drone"/></joint></robot>"""


def test_a_planar_joint_and_a_ball_have_three_sliders_and_a_floating_one_six(report: Report, chromium: Page) -> None:
    page = opened(chromium, report(PLANAR.format("0 1 0")))
    names = page.run("[...document.querySelectorAll('[data-axis]')].map((each) => each.dataset.axis)")
    assert names == [
        *(f"joint drive: {way}" for way in ("x", "y", "turn")),
        *(f"joint fly: {way}" for way in ("x", "y", "z", "yaw", "pitch", "roll")),
        *(f"joint look: {way}" for way in ("yaw", "pitch", "roll")),
    ]
    page.run("move('joint drive: x', 2), move('joint drive: y', 3), move('joint drive: turn', 0.3)")
    # x of the frame is in the plane, y is the cross product of the normal with it
    assert page.run("page.pose('link cart').slice(12, 15)") == pytest.approx([2, 0, 1 - 3])
    assert page.run("page.pose('link cart').slice(0, 3)") == pytest.approx([math.cos(0.3), 0, -math.sin(0.3)])
    sliders = "document.querySelectorAll('[data-axis^=\"joint look\"] input[type=range]')"
    turns = page.run(
        f"[...{sliders}].map((slider, place) => {{"
        " slider.value = 0.4 + place; slider.dispatchEvent(new Event('input')); return Number(slider.value); })"
    )
    yaw_pitch_roll = [page.run(f"page.positions.get('joint look: {way}')") for way in ("yaw", "pitch", "roll")]
    assert yaw_pitch_roll == turns
    eye, drone = (np.array(page.run(f"page.pose('link {name}')")).reshape(4, 4).T for name in ("eye", "drone"))
    rotation = pytest.importorskip("pinocchio").rpy.rpyToMatrix(*reversed(turns))
    assert np.abs((drone[:3, :3].T @ eye[:3, :3]) - rotation).max() < 1e-12
    page.run("page.positions.forEach((_, name) => move(name, 0))")
    x, y = place_of(page, "link eye")
    page.run(f"var taken = hitAt(placeOf({{ clientX: {x}, clientY: {y} }}), page.now).point")
    page.run("taken.applyMatrix4(page.now.bodies.get('link eye').group.matrixWorld.clone().invert())")
    page.drag((x, y), (x + 10, y), (x + 30, y + 20))  # all three turn, and what was taken stays under the pointer
    spot = page.run("project(taken.clone().applyMatrix4(page.now.bodies.get('link eye').group.matrixWorld))")
    assert spot[:2] == pytest.approx(page.run(f"placeOf({{ clientX: {x + 30}, clientY: {y + 20} }})"), abs=0.1)
    page.run("page.positions.forEach((_, name) => move(name, 0)), move('joint fly: z', 1)")
    page.run("move('joint fly: roll', 0.1), move('joint fly: pitch', 0.2), move('joint fly: yaw', 0.3)")
    pose = np.array(page.run("page.pose('link drone')")).reshape(4, 4).T
    origin = pytest.importorskip("pinocchio").rpy.rpyToMatrix(0.1, 0.2, 0.3)
    assert np.abs(pose[:3, :3] - origin).max() < 1e-12
    assert pose[:3, 3] == pytest.approx([0, 0, 2])
    assert page.problems == []


def test_atlas_without_its_meshes_is_a_skeleton(corpus: Path, report: Report, chromium: Page) -> None:
    page = opened(chromium, report((corpus / "robots/matlab/Atlas/urdf/atlas.urdf").read_text("utf-8")))
    assert page.run("page.layers.frame") is True
    assert page.run("document.querySelectorAll('[data-link]').length") == page.run("page.now.bodies.size")
    assert "is not in the package" in page.run("document.body.textContent")
    assert page.problems == []


def test_without_any_mesh_the_line_below_the_picture_names_one(report: Report, chromium: Page) -> None:
    shapes = (f'<visual><geometry><mesh filename="{name}.stl"/></geometry></visual>' for name in "ab")
    page = opened(chromium, report(f'<robot name="bare"><link name="base">{"".join(shapes)}</link></robot>'))
    said = "Only frames are shown: link base, visual 1: mesh a.stl is not in the package (and 1 more)"
    assert page.run("element('told').textContent") == said


NO_WEBGL = "HTMLCanvasElement.prototype.getContext = () => null"


def test_without_webgl_one_line_says_so_and_all_else_works(report: Report, chromium: Page) -> None:
    bare = "".join(f'<link name="{name}"/>' for name in "abc")
    joints = "".join(
        f'<joint name="{child}" type="continuous"><parent link="{parent}"/><child link="{child}"/></joint>'
        for parent, child in ("ab", "bc")
    )
    file = report(f'<robot name="bare">{bare}{joints}</robot>')
    page = opened(chromium, file)
    assert page.run("element('told').textContent") == "This robot has no shapes: its frames are shown."
    assert "no limit" in page.run("document.querySelector('[data-axis=\"joint b\"]').textContent")
    page.run("page.player.seek(5)")
    assert page.run("[...page.positions.values()]") == pytest.approx([1, 1])
    chromium.open(file, ready=READY, first=NO_WEBGL)
    (line,) = page.run("[...document.querySelectorAll('#trouble:not([hidden])')].map((each) => each.textContent)")
    assert line.startswith("This browser cannot draw in 3D: WebGL is missing, or switched off.")
    page.run("page.player.seek(5), document.querySelector('[data-pose=Random]').click()")
    assert page.run("page.positions.get('joint b')") != 1
    assert page.run("[element('tools').hidden, element('player').hidden]") == [True, False]
    page.run("select('link c'), document.querySelector('[role=tab]:not([aria-selected=true])').click()")
    assert not [problem for problem in page.problems if "Error creating WebGL context" not in problem]


SCRIPT = "</script><script>alert(1)</script><img src=x onerror=\"alert(2)\"> 'quoted' & <!-- `"


def test_names_with_scripts_are_shown_and_run_nothing(report: Report, chromium: Page) -> None:
    name = quoteattr(SCRIPT)
    urdf = f"""<robot name={name}><link name={name}>
      <visual name={name}><geometry><box size="1 1 1"/></geometry></visual></link>
      <link name="tip"/><joint name={name} type="revolute"><parent link={name}/><child link="tip"/>
      <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"""
    page = opened(chromium, report(urdf))
    shown = page.run("document.querySelector('[data-link]').textContent")
    assert shown == SCRIPT
    page.run("select(data.now.bodies[0].element), select(data.now.hinges[0].element)")
    assert page.run("document.scripts.length") == page.run("document.querySelectorAll('body > script').length")
    assert page.run("document.querySelectorAll('img').length") == 0
    assert page.problems == []


def test_the_policy_forbids_other_scripts_and_eval(report: Report, chromium: Page) -> None:
    page = opened(chromium, report('<robot name="still"><link name="only"/></robot>'))
    page.run("document.body.append(Object.assign(document.createElement('script'), {textContent: 'window.ran = 1'}))")
    assert page.run("typeof window.ran") == "undefined"
    assert (
        page.run(
            "(() => { const it = document.createElement('div'); it.setAttribute('onclick', 'window.ran = 1');"
            " it.click(); return typeof window.ran; })()"
        )
        == "undefined"
    )
    assert page.run("fetch('http://127.0.0.1:9/').then(() => 'sent', () => 'refused')") == "refused"
    page.run("setTimeout('window.ran = 1', 0), new Promise((go) => setTimeout(go, 50))")
    assert page.run("typeof window.ran") == "undefined"
    told = [problem for problem in page.problems if "Content Security Policy" in problem]
    assert any("127.0.0.1" in problem for problem in told)  # else there is just nobody who answers
    assert any("eval" in problem for problem in told)
    assert page.run("document.querySelector('meta[http-equiv]').content").count("unsafe") == 0


def test_a_robot_that_does_not_move_and_has_no_shape(report: Report, chromium: Page) -> None:
    page = opened(chromium, report('<robot name="still"><link name="only"/></robot>'))
    assert page.run("element('axes').textContent") == "Nothing here moves by itself."
    assert page.run("[element('player').hidden, element('poses').hidden]") == [True, True]
    assert page.problems == []


def test_shapes_are_as_large_as_they_are(report: Report, chromium: Page) -> None:
    """Each with half its extent along x, y and z."""
    shapes = {
        'box size="0.2 0.4 0.6"': (0.1, 0.2, 0.3),
        'sphere radius="0.2"': (0.2, 0.2, 0.2),
        'cylinder radius="0.1" length="0.4"': (0.1, 0.1, 0.2),
        'capsule radius="0.1" length="0.4"': (0.1, 0.1, 0.3),
        'ellipsoid radii="0.1 0.2 0.3"': (0.1, 0.2, 0.3),
    }
    visuals = "".join(f"<visual><geometry><{shape}/></geometry></visual>" for shape in shapes)
    page = opened(chromium, report(f'<robot name="bot"><link name="base">{visuals}</link></robot>'))
    layer = "page.now.bodies.get('link base').layers.visual"
    corners = f"{layer}.map((mesh) => (mesh.geometry.computeBoundingBox(), mesh.geometry.boundingBox.max.toArray()))"
    assert np.array(page.run(corners)) == pytest.approx(np.array(list(shapes.values())), rel=0.01)


def test_the_inertia_box_is_the_body_with_this_inertia(report: Report, chromium: Page) -> None:
    mass, squares, (turn, _) = (
        3.0,
        np.square([0.2, 0.4, 0.6]),
        np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3))),
    )
    tensor = turn @ np.diag(mass / 12 * (squares.sum() - squares)) @ turn.T
    names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    numbers = " ".join(
        f'{name}="{part!r}"' for name, part in zip(names, tensor[np.triu_indices(3)].tolist(), strict=True)
    )
    inertial = f'<origin xyz="1 2 3" rpy="0 0 {math.pi / 2}"/><mass value="{mass}"/><inertia {numbers}/>'
    page = opened(
        chromium, report(f'<robot name="bot"><link name="base"><inertial>{inertial}</inertial></link></robot>')
    )
    box = "page.now.bodies.get('link base').layers.inertia[0]"
    matrix = np.reshape(page.run(f"{box}.matrix.elements"), (4, 4)).T
    edges = page.run(f"(({{width, height, depth}}) => [width, height, depth])({box}.geometry.parameters)")
    assert np.linalg.det(matrix[:3, :3]) == pytest.approx(1)
    assert matrix[:3, 3] == pytest.approx([1, 2, 3])
    turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]) @ turn
    shape = matrix[:3, :3] @ np.diag(np.square(edges)) @ matrix[:3, :3].T
    assert shape == pytest.approx(turn @ np.diag(squares) @ turn.T, abs=1e-12)
    for none in ("1, 0, 0, 1, 0, 9", "0, 0, 0, 0, 0, 0", "1, 0, 0, 1, 0, null", "1e308, 0, 0, 1e308, 0, 1e308"):
        assert page.run(f"boxOf({{mass: 1e-3, inertia: [{none}]}})") is None


@pytest.mark.parametrize("dark", [False, True])
def test_a_narrow_window_needs_no_sideways_scrolling(arm: Path, report: Report, chromium: Page, dark: bool) -> None:
    page = opened(chromium, report(), width=400, dark=dark)
    assert page.run("document.documentElement.scrollWidth") == 400
    fits = "every((each) => each.scrollWidth <= each.clientWidth && each.scrollHeight <= each.clientHeight)"
    assert page.run(f"[...document.querySelectorAll('.scroll:not(#drawing)')].{fits}"), "no table is cut"
    assert page.run("document.documentElement.dataset.theme") == ("dark" if dark else "light")
    assert page.problems == []


def test_paper_is_light_and_has_the_whole_diagram(arm: Path, report: Report, chromium: Page) -> None:
    page = opened(chromium, report(), dark=True)
    page.run("dispatchEvent(new Event('beforeprint'))")
    assert page.run("document.documentElement.dataset.theme") == "light"
    width = "element('drawing').shadowRoot.querySelector('svg').style.width"
    assert page.run(width) == "100%"
    page.run("dispatchEvent(new Event('afterprint'))")
    assert page.run("document.documentElement.dataset.theme") == "dark"
    assert page.problems == []


def test_keys_do_what_buttons_do(arm: Path, report: Report, chromium: Page) -> None:
    page = opened(chromium, report())
    press = "document.body.dispatchEvent(new KeyboardEvent('keydown', {{key: {!r}, bubbles: true}}))"
    page.run(press.format("c"))
    assert page.run("element('switch-collision').getAttribute('aria-pressed')") == "true"
    assert page.run("page.now.bodies.get('link forearm').layers.collision[0].visible") is True
    page.run("move('joint elbow', -1)")
    page.run(press.format("r"))
    assert page.run("page.positions.get('joint elbow')") == 0
    page.run("select('link forearm')")
    page.run(press.format("Escape"))
    assert page.run("page.selected") is None
    assert page.problems == []
