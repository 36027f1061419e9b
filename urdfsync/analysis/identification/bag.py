"""Reads joint states from a recording of ROS 2: a folder with `metadata.yaml`, or one file (MCAP or SQLite)."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from urdfsync.common.diagnostics import ConfigError, SourceError, UrdfsyncError
from urdfsync.common.extras import install_command
from urdfsync.common.files import shown
from urdfsync.domain.regressor import QUANTITIES, Array

TOO_LARGE = "the log unpacks to more than"
_TYPE = "sensor_msgs/msg/JointState"
_NAMED = 1000
"""The joints are those that so many first messages name."""


class Message(NamedTuple):
    """One joint state."""

    received: float
    """When the message was recorded, in s."""
    stamp: float
    """The time of its header; 0 if it has none."""
    joints: list[str]
    values: dict[str, Array]
    """By quantity; empty arrays for quantities that the message does not have."""


class Bag:
    """The joint states of one topic."""

    def __init__(self, file: Path, topic: str, most: float = math.inf) -> None:
        """Raises UrdfsyncError without such messages, for more than `most` bytes, and for a topic that is not clear."""
        self.file, self.topic, self._most = file, topic, most
        first = list(itertools.islice(self._messages(), _NAMED))
        if not first:
            raise SourceError.of("log", f"topic {self.topic} has no messages", shown(file))
        self._has_stamps = all(message.stamp for message in first)
        columns = dict[tuple[str, str], None]()  # in the order of the messages
        for message in first:
            for quantity, values in message.values.items():
                pairs = zip(message.joints, values, strict=False)
                # ros2_control sends NaN for what a joint does not measure
                columns |= dict.fromkeys((name, quantity) for name, value in pairs if np.isfinite(value))
        self._columns = [*columns]
        self.header = ["time", *(f"{name}.{quantity}" for name, quantity in self._columns)]

    def rows(self, size: int) -> Iterator[Array]:
        """Yield the messages as rows of numbers, `size` at a time; NaN for a joint that a message does not have."""
        places = {column: place for place, column in enumerate(self._columns, 1)}
        source = self._messages()
        while messages := list(itertools.islice(source, size)):
            rows = np.full((len(messages), len(self.header)), np.nan)
            for row, message in zip(rows, messages, strict=True):
                row[0] = message.stamp if self._has_stamps else message.received
                for quantity, values in message.values.items():
                    for name, value in zip(message.joints, values, strict=False):
                        if (name, quantity) in places:
                            row[places[name, quantity]] = value
            yield rows

    def _messages(self) -> Iterator[Message]:
        try:
            from rosbags.rosbag2 import Reader
            from rosbags.typesys import Stores, get_typestore
        except ImportError:
            message = "recordings of ROS 2 need rosbags, which is not installed"
            raise ConfigError.of("log", message, hint=install_command("log")) from None
        types = get_typestore(Stores.ROS2_HUMBLE)
        try:
            with Reader(self.file) as reader:
                chosen = self._choose(reader.connections)
                size = 0
                for _, received, content in reader.messages(chosen):
                    size += len(content)
                    if size > self._most:
                        raise SourceError.of("log", f"{TOO_LARGE} {self._most:.3g} bytes", shown(self.file))  # noqa: TRY301
                    state: Any = types.deserialize_cdr(content, _TYPE)
                    stamp = state.header.stamp.sec + 1e-9 * state.header.stamp.nanosec
                    values = {quantity: getattr(state, quantity) for quantity in QUANTITIES}
                    yield Message(1e-9 * received, stamp, state.name, values)
        except (UrdfsyncError, MemoryError):
            raise
        # a damaged file raises errors of rosbags, SQLite, LZ4, Zstandard, struct or YAML
        except Exception as error:  # noqa: BLE001
            reason = str(error).partition("\n")[0].rstrip(".") or type(error).__name__
            raise SourceError.of("log", f"the recording can't be read: {reason}", shown(self.file)) from None

    def _choose(self, connections: list[Any]) -> list[Any]:
        topics = {each.topic: each.msgtype for each in connections}
        states = [topic for topic, kind in topics.items() if kind == _TYPE]
        if self.topic and self.topic not in states:
            kind = topics.get(self.topic)
            message = f"topic {self.topic} has {kind}" if kind else f"there is no topic {self.topic}"
            others = f"topics with joint states: {', '.join(sorted(states))}" if states else "no topic has joint states"
            raise ConfigError.of("log", message, shown(self.file), hint=others)
        if not states:
            message = f"no topic has {_TYPE}: {', '.join(sorted(topics)) or 'the recording is empty'}"
            raise SourceError.of("log", message, shown(self.file))
        if not self.topic and len(states) > 1:
            message = f"{len(states)} topics have joint states: {', '.join(sorted(states))}"
            raise ConfigError.of("log", message, shown(self.file), hint=f"choose one: `--topic {sorted(states)[0]}`")
        self.topic = self.topic or states[0]
        return [each for each in connections if each.topic == self.topic and each.msgtype == _TYPE]
