"""The prescribed motion: inside limits, the same everywhere, and nowhere so slow that a fault hides."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from urdfsync.urdf.physics.motion import axis_course
from urdfsync.urdf.robot import Joint, JointType, Limit

NAMES = st.text(min_size=1, max_size=20)


def joint(kind: JointType, name: str = "elbow", limits: Limit | None = None) -> Joint:
    return Joint(name, kind, "upper", "fore", limit=limits)


@given(NAMES, st.floats(-10, 10), st.floats(1e-6, 20))
def test_axes_begin_in_the_middle_half_of_their_range(name: str, lower: float, width: float) -> None:
    upper = min(lower + width, 10.0)
    if lower < upper:
        course = axis_course(joint("revolute", name, Limit(lower, upper)))
        quarter = (upper - lower) / 4
        assert lower + quarter - 1e-9 <= course.position <= upper - quarter + 1e-9
        assert 0.25 <= abs(course.speed) <= 0.5, "losses would hide in a slower motion"
        assert 0.5 <= abs(course.acceleration) <= 1.0


def test_the_motion_is_the_same_on_every_machine_and_another_for_each_joint() -> None:
    assert axis_course(joint("continuous")) == (0.3658443950165243, 0.3519522504876569, -0.5698369843751905)
    names = [f"joint_{number}" for number in range(50)]
    assert len({axis_course(joint("continuous", name)) for name in names}) == 50
