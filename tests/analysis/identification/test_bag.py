"""Recordings of ROS 2: folders and single files, in MCAP and SQLite, with one or more topics of joint states."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support import measured
from support.commands import Execute
from support.files import unchanged

from urdfsync.analysis.identification.bag import Bag
from urdfsync.analysis.identification.log import Log
from urdfsync.analysis.identification.results import IdentifyOptions
from urdfsync.common.diagnostics import ConfigError, SourceError, UrdfsyncError
from urdfsync.domain.regressor import Axis

rosbag2 = pytest.importorskip("rosbags.rosbag2")
typesys = pytest.importorskip("rosbags.typesys")

TYPES = typesys.get_typestore(typesys.Stores.ROS2_HUMBLE)
TYPE = "sensor_msgs/msg/JointState"
ELBOW = Axis("elbow", "elbow", "rad", 0.0, (-1.5, 1.5), 3.0, 20.0, 50.0, "position", "elbow_phi")


def state(names: Sequence[str], position: Sequence[float], effort: Sequence[float], stamp: float) -> Any:
    kinds = TYPES.types
    time = kinds["builtin_interfaces/msg/Time"](sec=int(stamp), nanosec=round(stamp % 1 * 1e9))
    header = kinds["std_msgs/msg/Header"](stamp=time, frame_id="")
    return kinds[TYPE](
        header=header,
        name=list(names),
        position=np.array(position, float),
        velocity=np.array([], float),
        effort=np.array(effort, float),
    )


def write(folder: str, topics: dict[str, list[tuple[float, Any]]], storage: str = "MCAP") -> Path:
    """Write the messages of each topic with the times at which they were recorded."""
    with rosbag2.Writer(Path(folder), version=9, storage_plugin=rosbag2.StoragePlugin[storage]) as writer:
        for topic, messages in topics.items():
            kind = messages[0][1].__msgtype__ if messages else TYPE
            connection = writer.add_connection(topic, kind, typestore=TYPES)
            for time, message in messages:
                writer.write(connection, round(time * 1e9), TYPES.serialize_cdr(message, kind))
    return Path(folder)


def states(count: int = 100, *, delay: float = 0.005, has_stamps: bool = True) -> list[tuple[float, Any]]:
    """States of an elbow and of a wrist, which are recorded later than measured."""
    times = [1000 + 0.01 * k for k in range(count)]
    return [
        (t + delay, state(["wrist", "elbow"], [0.5, np.sin(t)], [1, 10 * np.cos(t)], t if has_stamps else 0.0))
        for t in times
    ]


@pytest.mark.parametrize("storage", ["MCAP", "SQLITE3"])
def test_folders_and_single_files_are_the_same(folder: Path, storage: str) -> None:
    bag = write("bag", {"/joint_states": states()}, storage)
    (single,) = (file for file in bag.iterdir() if file.suffix in (".mcap", ".db3"))
    for file in (bag, single):
        log = Log(file, [ELBOW], IdentifyOptions())
        (piece,) = log.pieces()
        assert piece.position[50, 0] == pytest.approx(np.sin(1000.5))
        assert piece.effort[50, 0] == pytest.approx(10 * np.cos(1000.5))
        assert "columns without a use: wrist.position, wrist.effort" in log.told()


@pytest.mark.parametrize(("has_stamps", "first"), [(True, 1000.0), (False, 1000.005)])
def test_times_are_those_of_headers_if_there_are_any(folder: Path, has_stamps: bool, first: float) -> None:
    bag = Bag(write("bag", {"/joint_states": states(has_stamps=has_stamps)}), "")
    assert next(bag.rows(10))[0, 0] == pytest.approx(first, abs=1e-6)


def test_messages_without_a_joint_have_no_number_for_it(folder: Path) -> None:
    messages = states(60)
    messages[7] = messages[7][0], state(["wrist"], [0.5], [1], 1000.07)
    log = Log(write("bag", {"/joint_states": messages}), [ELBOW], IdentifyOptions())
    (piece,) = log.pieces()
    assert len(piece.times) == 59
    assert log.told()[0] == "1 row without a number"


def test_a_joint_without_a_sensor_sends_no_numbers(folder: Path) -> None:
    """As ros2_control does it: the rows of the other joints are used."""
    messages = [(t, state(["slide", "elbow"], [0.1, np.sin(t)], [np.nan, 1.0], t)) for t in np.arange(1, 2, 0.01)]
    slide = ELBOW._replace(name="slide", component="slide")
    log = Log(write("bag", {"/joint_states": messages}), [ELBOW, slide], IdentifyOptions())
    (piece,) = log.pieces()
    assert len(piece.times) == len(messages)
    assert log.measured == [0]


def test_a_topic_is_chosen(folder: Path) -> None:
    bag = write("bag", {"/left/joint_states": states(), "/right/joint_states": states(60)})
    with pytest.raises(ConfigError, match="2 topics have joint states: /left/joint_states, /right/joint_states"):
        Bag(bag, "")
    assert len(next(Bag(bag, "/right/joint_states").rows(1000))) == 60
    with pytest.raises(ConfigError, match="there is no topic /joint_states; topics with joint states: /left"):
        Bag(bag, "/joint_states")


def test_other_recordings_are_refused(folder: Path) -> None:
    kinds = TYPES.types
    text = kinds["std_msgs/msg/String"](data="hello")
    with pytest.raises(SourceError, match="no topic has sensor_msgs/msg/JointState: /chatter"):
        Bag(write("other", {"/chatter": [(1.0, text)]}), "")
    with pytest.raises(ConfigError, match="topic /chatter has std_msgs/msg/String; no topic has joint states"):
        Bag(Path("other"), "/chatter")
    with pytest.raises(SourceError, match="topic /joint_states has no messages"):
        Bag(write("empty", {"/joint_states": []}), "")
    unnamed = [(1.0, state([], [], [], 1.0))]
    with pytest.raises(SourceError, match="no joint has a position and an effort"):
        Log(write("unnamed", {"/joint_states": unnamed}), [ELBOW], IdentifyOptions())
    Path("log.csv").write_text("time,elbow.position,elbow.effort\n0,1,2\n")
    with pytest.raises(ConfigError, match="`--topic` is for recordings of ROS 2"):
        Log(Path("log.csv"), [ELBOW], IdentifyOptions(topic="/joint_states"))


@pytest.mark.parametrize("storage", ["MCAP", "SQLITE3"])
@pytest.mark.parametrize("share", [0.0, 0.02, 0.5, 0.9])
def test_a_truncated_file_is_one_error(folder: Path, storage: str, share: float) -> None:
    bag = write("bag", {"/joint_states": states(3000)}, storage)
    (single,) = (file for file in bag.iterdir() if file.suffix in (".mcap", ".db3"))
    single.write_bytes(single.read_bytes()[: int(share * single.stat().st_size)])
    for file in (bag, single):
        with pytest.raises(UrdfsyncError, match=r"^[^\n]*(can't be read|no topic has|there is no)[^\n]*$"):
            list(Log(file, [ELBOW], IdentifyOptions()).pieces())


@pytest.mark.slow
def test_a_recording_is_fitted(gripper: Path, execute: Execute, recording: measured.Recording) -> None:
    rows = zip(recording.times, recording.positions, recording.efforts, strict=True)
    write("bag", {"/joint_states": [(t + 5, state(recording.joints, q, tau, t + 5)) for t, q, tau in rows]})
    with unchanged(gripper):
        by_bag, by_csv = (
            execute("identify", "gripper", log, "--joint", "drive", "--format=json").json["results"][0]
            for log in ("bag", "log.csv")
        )
    for one, other in zip(by_bag["numbers"], by_csv["numbers"], strict=True):
        assert abs(one["after"] - other["after"]) < 0.3 * other["error"], "times differ by the last digit"
