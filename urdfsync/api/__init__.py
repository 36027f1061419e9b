"""The functions behind the commands, for scripts and notebooks: `urdfsync.build` and the others (docs/api.md).

They print nothing. What a command would end with as an error, they raise.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TypeAlias, TypeVar

from urdfsync import config as configuration
from urdfsync.config import Config, RobotConfig
from urdfsync.diagnostics import ConfigError
from urdfsync.output.console import StyledLine, html

R = TypeVar("R")
Place: TypeAlias = Config | Path | str | None
"""A configuration, or its file; None for `urdfsync.toml` in the working folder or the nearest one above."""


def ignore(_result: object) -> None:
    """Do nothing with a result."""


class Results(list[R]):
    """The results of a call, one for each robot, in the order of the configuration.

    As text, and in a notebook, they look as the command shows them.
    """

    def __init__(
        self,
        results: Iterable[R],
        lines: Callable[[R], Iterable[StyledLine]],
        on_result: Callable[[R], object] = ignore,
    ) -> None:
        """`lines` shows a result; `on_result` gets each as soon as it is there."""
        super().__init__()
        self._lines = lines
        for result in results:
            self.append(result)
            on_result(result)

    def __str__(self) -> str:
        return "\n".join(str(line) for result in self for line in self._lines(result))

    def _repr_html_(self) -> str:
        return html(line for result in self for line in self._lines(result))


def load(config: Place = None) -> Config:
    """Return the configuration in a file; one that is loaded stays as it is.

    Its `robots` have their names, sources and packages. Raises ConfigError with all that is wrong in the file.
    """
    if isinstance(config, Config):
        return config
    return configuration.load(Path(config) if config else configuration.find(configuration.working_folder()))


def select_one(config: Config, robots: Sequence[str], command: str) -> RobotConfig:
    """Return the robot that names mean, or the only one. Raises ConfigError for several, which `command` refuses."""
    chosen = config.select(robots)
    if len(chosen) > 1:
        names = ", ".join(robot.name for robot in chosen)
        message = f"{len(chosen)} robots are meant; `urdfsync {command}` takes one at a time"
        raise ConfigError.of("robots", message, hint=f"name one: {names}")
    return chosen[0]
