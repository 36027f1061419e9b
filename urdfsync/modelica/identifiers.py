"""Makes names of a source into Modelica identifiers that differ; `docs/naming.md` states the rule for users."""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from collections.abc import Iterable, Mapping

from urdfsync.domain import ElementKey
from urdfsync.modelica.names import DEVICES, FUNCTIONS, KEYWORDS, RESERVED_CLASSES, in_ascii

LONGEST = 100
"""Longer identifiers are cut, since file systems allow 255 bytes."""
RESERVED = KEYWORDS | {name.lower() for name in FUNCTIONS} | RESERVED_CLASSES | DEVICES
"""Names, in lower case, that mean something else in every package."""

_UNFIT = re.compile(r"[^A-Za-z0-9]+")
_TWIN = re.compile(r".*_(?:link|joint|loop|sensor|element)_[0-9a-f]{6}(?:[0-9a-f]{58})?")
"""Matches the spellings of twins: no other element may have one."""
_DIGITS = 6


def stem(name: str, kind: str) -> str:
    """Return the letters and digits of a name with `_` between them, and a small first letter."""
    plain = _UNFIT.sub("_", in_ascii(name)).strip("_")
    if not plain[:1].isalpha():
        plain = f"{kind}_{plain}".rstrip("_")
    return plain[0].lower() + plain[1:]


def is_free(spelling: str) -> bool:
    """Return whether an element may have this identifier in any package."""
    return len(spelling) <= LONGEST and spelling.lower() not in RESERVED and not _TWIN.fullmatch(spelling)


def hashed(name: str, kind: str, mark: str = "", digits: int = _DIGITS) -> str:
    """Return the stem of a name with a mark and a hash of kind and name."""
    ending = f"{mark}_{hashlib.sha256(f'{kind} {name}'.encode('utf-8', 'surrogatepass')).hexdigest()[:digits]}"
    return stem(name, kind)[: LONGEST - len(ending)] + ending


def tell_apart(spelled: Mapping[ElementKey, str], taken: Iterable[str] = ()) -> Mapping[ElementKey, str]:
    """Return an identifier for each element; `spelled` has the spellings of elements without twins.

    All differ, ignoring case, and none is in `taken`. Each element has three possible spellings and gets the first one
    that no other element has; the third is unique. So no twin gets its first spelling, and a new element never takes
    the former name of another element.
    """
    folded, taken = {spelling.lower() for spelling in spelled.values()}, {name.lower() for name in taken}
    if len(folded) == len(spelled) and folded.isdisjoint(taken):
        return spelled  # nearly always: no twins
    spellings = {
        (kind, name): (first, *(hashed(name, kind, f"_{kind}", digits) for digits in (_DIGITS, 64)))
        for (kind, name), first in spelled.items()
    }
    uses = Counter(spelling.lower() for three in spellings.values() for spelling in three)
    uses.update(taken)
    return {
        key: next((spelling for spelling in three if uses[spelling.lower()] == 1), three[-1])
        for key, three in spellings.items()
    }
