"""What a check has found so far: grows while it works, also from several threads, and is a verdict at any time."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import msgspec

from urdfsync.checking.verdict import Compiled, Effect, Verdict
from urdfsync.diagnostics import Diagnostic


class Findings:
    """Collects what there is to say of one robot; each addition hands the verdict so far to `keep`."""

    def __init__(self, robot: str, package: str, keep: Callable[[Verdict], None]) -> None:
        self._verdict = Verdict(robot, package)
        self._keep = keep
        self._lock = threading.Lock()
        self._begun = time.monotonic()

    @property
    def verdict(self) -> Verdict:
        """What is known now."""
        return msgspec.structs.replace(self._verdict, seconds=time.monotonic() - self._begun)

    def note(self, **facts: Any) -> None:
        """Set fields of the verdict."""
        self._change(lambda verdict: msgspec.structs.replace(verdict, **facts))

    def say(self, diagnostics: Iterable[Diagnostic]) -> None:
        """Add diagnostics, each once."""
        new = tuple(diagnostics)
        self._change(lambda v: msgspec.structs.replace(v, diagnostics=tuple(dict.fromkeys((*v.diagnostics, *new)))))

    def compiled(self, model: Compiled) -> None:
        """Add a model that compiles."""
        self._change(lambda v: msgspec.structs.replace(v, compiled=(*v.compiled, model)))

    def effects(self, found: Iterable[Effect], owners: Mapping[str, str]) -> None:
        """Set what edits do; `owners` are the elements that files belong to."""
        named = (
            msgspec.structs.replace(one, owners=tuple(dict.fromkeys(map(owners.__getitem__, one.files))))
            for one in found
        )
        self.note(effects=tuple(named))

    def miss(self, *sentences: str) -> None:
        """Add what should have been checked and could not be, and why."""
        self._change(lambda v: msgspec.structs.replace(v, gaps=tuple(dict.fromkeys((*v.gaps, *sentences)))))

    def leave_out(self, *sentences: str) -> None:
        """Add what is not checked, and why."""
        self._change(lambda v: msgspec.structs.replace(v, unchecked=tuple(dict.fromkeys((*v.unchecked, *sentences)))))

    def used(self, megabytes: float) -> None:
        """Take note of the memory of a process."""
        self._change(lambda v: msgspec.structs.replace(v, megabytes=max(v.megabytes, megabytes)))

    def _change(self, change: Callable[[Verdict], Verdict]) -> None:
        with self._lock:
            self._verdict = change(self._verdict)
            self._keep(self.verdict)
