"""Turns URDF names into Modelica identifiers: an identifier depends only on the name of its element.

Twins are the exception: elements of equal names, or of names that differ only in case. Links and joints of a robot
share one namespace, because both become components of the robot model. `docs/naming.md` states the rule for users.
"""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from collections.abc import Iterable, Mapping

import msgspec

from urdfsync.domain import ElementKey
from urdfsync.modelica.names import DEVICES, FUNCTIONS, KEYWORDS, RESERVED_CLASSES, in_ascii

GENERATED = frozenset(
    "animation bodyinertias bodymasses bodymoments checklimits connectionmatrix drawnshapes driveinertias firstjoints "
    "fixedstart followerangles followerlengths followermultipliers followers frame_a frame_b ground inertialangles "
    "jointangles jointaxes jointnames jointorigins jointpositions jointrotations joints jointtree linkbodies "
    "linkcenters linkinertias linkmasses linkpositions linkrotations links m moveablejoints movingjoints name "
    "nextjoints parameters phi_start resources rotationalaxes rotationalaxis rotationaljoints rotationalrange "
    "rotationalsupport s_start showcollisions slideaxes sliding slidingjoints slidinglimits slidinglosses "
    "slidingmasses standingheight startpositions translationalaxes translationalaxis translationaljoints "
    "translationalrange translationalsupport tree turnaxes turning turninginertias turningjoints turninglimits "
    "turninglosses v_start visuals w_start world".split()
)
"""Names, in lower case, that models and records of robots use for other things than links and joints."""

LONGEST = 100
"""Longer identifiers are cut, since file systems allow 255 bytes."""

RESERVED_SUFFIXES = ("parameters", "run", "test")
"""Endings of generated class names, in lower case."""

_PLAIN = re.compile(
    r"(?!.*_(?:link|joint|loop|sensor)_[0-9a-f]{6}(?:[0-9a-f]{58})?$)[A-Za-z](?:[_-]?[A-Za-z0-9])*[_-]?"
)
"""Names that need no hash: without two underscores or hyphens in a row, and without the ending of twins."""
_UNFIT = re.compile(r"[^A-Za-z0-9]+")
_PARTS = re.compile(r"[0-9]+|[^0-9]+")
_RESERVED = KEYWORDS | {name.lower() for name in FUNCTIONS} | RESERVED_CLASSES | DEVICES
_DIGITS = 6


class Identifier(msgspec.Struct, frozen=True):
    """The Modelica spellings of one link or joint."""

    component: str
    """The component in the robot model, with a small first letter."""

    @property
    def type(self) -> str:
        """The class, and the stem of its file, with a capital first letter."""
        return self.component[0].upper() + self.component[1:]

    @property
    def record(self) -> str:
        """The class of the parameter record."""
        return self.type + "Parameters"


def is_reserved(spelling: str) -> bool:
    """Return whether an identifier would collide with a keyword, a library or a generated name."""
    folded = spelling.lower()
    return folded in _RESERVED or folded.endswith(RESERVED_SUFFIXES) or folded in GENERATED


def spell(name: str, kind: str) -> str:
    """Return the identifier of an element without a twin: the name, or the usable part of the name with a hash."""
    if name == "world":  # the root of nearly all sources in MJCF and SDF
        return f"{name}{kind.capitalize()}"
    plain = name.replace("-", "__")
    if _PLAIN.fullmatch(name) and len(plain) <= LONGEST and not is_reserved(plain):
        return plain[0].lower() + plain[1:]
    return _hashed(name, kind)


def _hashed(name: str, kind: str, mark: str = "", digits: int = _DIGITS) -> str:
    stem = _UNFIT.sub("_", in_ascii(name)).strip("_")
    if not stem[:1].isalpha():
        stem = f"{kind}_{stem}".rstrip("_")
    ending = f"{mark}_{hashlib.sha256(f'{kind} {name}'.encode('utf-8', 'surrogatepass')).hexdigest()[:digits]}"
    return stem[0].lower() + stem[1 : LONGEST - len(ending)] + ending


def natural_key(name: str) -> tuple[tuple[int, int, str, str], ...]:
    """Return a sort key in which `link10` follows `link9`; distinct names have distinct keys."""
    return tuple(
        (0, len(part.lstrip("0")), part.lstrip("0"), part) if "0" <= part[0] <= "9" else (1, 0, part, part)
        for part in _PARTS.findall(name)
    )


def identify(names: Iterable[ElementKey], taken: Iterable[str] = ()) -> Mapping[ElementKey, Identifier]:
    """Return identifiers of all links, joints and loops.

    All differ, ignoring case, and none is in `taken`. Each element has three possible spellings and gets the first one
    that no other element has; the third is unique. So no twin gets its first spelling, and a new element never takes
    the former name of another element.
    """
    spelled = {key: spell(key[1], key[0]) for key in names}
    folded, taken = {spelling.lower() for spelling in spelled.values()}, {name.lower() for name in taken}
    if len(folded) == len(spelled) and folded.isdisjoint(taken):
        return {key: Identifier(spelling) for key, spelling in spelled.items()}  # nearly always: no twins
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
