"""Turns URDF names into Modelica identifiers: an identifier depends only on its element's own name.

Twins are the exception: elements whose names differ at most in case and kind. Links and joints of a robot share one
namespace, because both become components of the robot model. `docs/naming.md` states the rule for users.
"""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from collections.abc import Iterable, Mapping

import msgspec

from urdfsync.domain import ElementKey
from urdfsync.modelica.names import DEVICES, FUNCTIONS, KEYWORDS, RESERVED_CLASSES

GENERATED = frozenset(
    "animation bodyinertias bodymasses bodymoments checklimits connectionmatrix drawnshapes driveinertias firstjoints "
    "fixedstart followerangles followerlengths followermultipliers followers frame_a frame_b ground inertialangles "
    "jointangles jointaxes jointnames jointorigins jointpositions jointrotations joints jointtree linkbodies "
    "linkcenters linkinertias linkmasses linkpositions linkrotations links m moveablejoints movingjoints name "
    "nextjoints parameters phi_start resources rotationalaxes rotationalaxis rotationaljoints rotationalrange "
    "rotationalsupport s_start showcollisions slideaxes sliding slidingjoints slidinglimits slidinglosses "
    "slidingmasses standingheight startpositions translationalaxes translationalaxis translationaljoints "
    "translationalrange translationalsupport tree turnaxes turning turninginertias turningjoints turninglimits "
    "turninglosses v_start visualizationsetup visuals w_start world".split()
)
"""Names, in lower case, that models and records of robots use besides those of links and joints."""

LONGEST = 100
"""A longer spelling is cut, since file systems allow 255 bytes."""

RESERVED_SUFFIXES = ("parameters", "run", "test")
"""Endings, in lower case, that make class names from other class names."""

_PLAIN = re.compile(
    r"(?!.*_(?:link|joint|loop|sensor)_[0-9a-f]{6}(?:[0-9a-f]{58})?$)[A-Za-z](?:[_-]?[A-Za-z0-9])*[_-]?"
)
"""Unchanged names: without two underscores or hyphens in a row, and without the ending of twins."""
_UNFIT = re.compile(r"[^A-Za-z0-9]+")
_PARTS = re.compile(r"[0-9]+|[^0-9]+")
_RESERVED = KEYWORDS | {name.lower() for name in FUNCTIONS} | RESERVED_CLASSES | DEVICES
_DIGITS = 6


class Identifier(msgspec.Struct, frozen=True):
    """The Modelica spellings of one link or joint."""

    component: str
    """The component in the robot model; begins with a small letter."""

    @property
    def type(self) -> str:
        """The class, and the stem of its file; begins with a capital letter."""
        return self.component[0].upper() + self.component[1:]

    @property
    def record(self) -> str:
        """The class of the parameter record."""
        return self.type + "Parameters"


def is_reserved(spelling: str) -> bool:
    """Return whether an identifier would collide with the language, a library or generated text."""
    folded = spelling.lower()
    return folded in _RESERVED or folded.endswith(RESERVED_SUFFIXES) or folded in GENERATED


def spell(name: str, kind: str) -> str:
    """Return the identifier of an element without a twin: its name, or the usable part of its name with a hash."""
    plain = name.replace("-", "__")
    if _PLAIN.fullmatch(name) and len(plain) <= LONGEST and not is_reserved(plain):
        return plain[0].lower() + plain[1:]
    return _hashed(name, kind)


def _hashed(name: str, kind: str, mark: str = "", digits: int = _DIGITS) -> str:
    if not name.isascii():
        from anyascii import anyascii  # 30 ms, which a build without such names does not need

        ascii_name = anyascii(name)
    else:
        ascii_name = name
    stem = _UNFIT.sub("_", ascii_name).strip("_")
    if not stem[:1].isalpha():
        stem = f"{kind}_{stem}".rstrip("_")
    ending = f"{mark}_{hashlib.sha256(f'{kind} {name}'.encode('utf-8', 'surrogatepass')).hexdigest()[:digits]}"
    return stem[0].lower() + stem[1 : LONGEST - len(ending)] + ending


def natural_key(name: str) -> tuple[tuple[int, int, str, str], ...]:
    """Return a sort key in which `link10` follows `link9`; distinct names have distinct keys.

    Numbers go before words, by their value, and then by their leading zeros.
    """
    return tuple(
        (0, len(part.lstrip("0")), part.lstrip("0"), part) if "0" <= part[0] <= "9" else (1, 0, part, part)
        for part in _PARTS.findall(name)
    )


def identify(names: Iterable[ElementKey], taken: Iterable[str] = ()) -> Mapping[ElementKey, Identifier]:
    """Return identifiers of all links, joints and loops; no two are equal when case is folded, none is in `taken`.

    Each element has three spellings; the last one is unique. It gets the first of them that no other element has. So
    none of several twins gets its first spelling, and a new element never takes another one's former name.
    """
    spelled = {key: spell(key[1], key[0]) for key in names}
    folded, taken = {spelling.lower() for spelling in spelled.values()}, {name.lower() for name in taken}
    if len(folded) == len(spelled) and folded.isdisjoint(taken):
        return {key: Identifier(spelling) for key, spelling in spelled.items()}  # nearly always: there are no twins
    spellings = {
        (kind, name): (first, *(_hashed(name, kind, f"_{kind}", digits) for digits in (_DIGITS, 64)))
        for (kind, name), first in spelled.items()
    }
    uses = Counter(spelling.lower() for three in spellings.values() for spelling in three)
    uses.update(taken)
    return {
        key: Identifier(next((spelling for spelling in three if uses[spelling.lower()] == 1), three[-1]))
        for key, three in spellings.items()
    }
