"""How a configuration that `init` wrote is shown."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import TYPE_CHECKING

from urdfsync.config import shown
from urdfsync.views.terminal import text

if TYPE_CHECKING:
    from rich.text import Text

    from urdfsync.init import Draft


def lines(draft: Draft) -> Iterator[Text]:
    """What was written, and what was guessed and why."""
    yield text((shown(draft.file), "bold"), (" written", ""))
    for guess in draft.guesses:
        yield text(
            ("  ", ""), (guess.robot, "bold"), (f": {guess.source} becomes package ", ""), (guess.package, "bold")
        )
        for option in guess.options:
            value = json.dumps(option.value)
            yield text((f"    {option.option} = {value}", ""), (f"  guessed: {option.reason}", "dim"))
    yield text(("Look it over, then run `urdfsync build`.", ""))
