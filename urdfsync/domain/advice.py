"""A domain's advice on its options."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol, TypeAlias

import msgspec

from urdfsync.common.diagnostics import Diagnostic
from urdfsync.domain.model import Snapshot, Target


class Proposal(msgspec.Struct, frozen=True):
    """A value that `init` writes for one option, with the reason."""

    option: str
    value: Any
    reason: str
    settles: str = ""
    """The code of findings that the value settles; empty for none."""


Starter: TypeAlias = Callable[[Snapshot], Mapping[str, str]]
"""Returns templates for `init` to write, by their paths; the domain's attribute `starter`."""


class Advice(Protocol):
    """Advises on a domain's options; the domain's attribute `advice`."""

    def propose(self, snapshot: Snapshot, diagnostics: Sequence[Diagnostic]) -> Sequence[Proposal]:
        """Return option values that suit a model better than the defaults, for `init`.

        `diagnostics` come from reading the model with `Domain.permissive_options`.
        """
        ...

    def option_for(self, name: str, snapshot: Snapshot, target: Target, options: Any) -> str:
        """Return the option in the configuration's words that adds a class, connector, input or output; else empty."""
        ...


def brings_back(option: str, new_name: str = "") -> str:
    """Return the hint to set the option that brings a name back, perhaps as a new name; empty without an option."""
    return f"set `{option}` to bring it back{f' as `{new_name}`' if new_name else ''}" if option else ""
