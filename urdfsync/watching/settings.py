"""The configuration as the daemon sees it: read again when it has changed, the last good one in force until then."""

from __future__ import annotations

import msgspec

from urdfsync import config
from urdfsync.config import Config, RobotConfig, warnings
from urdfsync.diagnostics import ConfigError, Diagnostic
from urdfsync.watching.options import Options
from urdfsync.watching.samples import Sample, alike
from urdfsync.watching.settling import Settler, Verdict


class Loaded(msgspec.Struct, frozen=True):
    """A configuration that can be used."""

    config: Config
    robots: tuple[RobotConfig, ...]
    """Those of them that are watched."""
    advice: tuple[Diagnostic, ...]
    """What looks like a slip in it."""


class Settings:
    """The configuration file, which settles as sources do."""

    def __init__(self, options: Options) -> None:
        self._options = options
        self.settler: Settler[Sample] = Settler(options.times)
        self._read: Sample = {}
        self._trouble: tuple[Diagnostic, ...] = ()

    def load(self, sample: Sample) -> Loaded:
        """Read the configuration, of which this is the sample. Raises ConfigError."""
        self._read = sample
        loaded = config.load(self._options.file)
        robots = loaded.select(self._options.robots)
        self._trouble = ()
        return Loaded(loaded, robots, tuple(warnings.find_warnings(loaded, robots)))

    def has_changed(self, sample: Sample) -> bool:
        """Whether the file is not what it was when it was read."""
        return not alike(self._read, sample)

    def look(self, sample: Sample, now: float) -> Loaded | tuple[Diagnostic, ...]:
        """What there is new when a sample is due: a configuration, or what is wrong with it; nothing for neither."""
        if self.settler.look(sample, now) is not Verdict.SETTLED:
            return ()
        self.settler.rest()
        if not self.has_changed(sample):
            return ()
        before = self._trouble
        try:
            return self.load(sample)
        except ConfigError as error:
            self._trouble = error.diagnostics
            return () if before == self._trouble else self._trouble
