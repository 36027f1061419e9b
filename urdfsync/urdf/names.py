"""URDF names to Modelica identifiers: one rule, injective, a function of the set of names alone.

Links and joints of a robot share one namespace, because both become components of the robot model.
`docs/naming.md` states the rule for users.
"""

from __future__ import annotations

import hashlib
import re
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
"""Names, folded to lower case, that models and records of robots use beside those of links and joints."""

LONGEST = 100
"""A longer spelling is cut, since file systems end at 255 bytes."""

RESERVED_SUFFIXES = ("parameters", "run", "test")
"""Endings, folded to lower case, by which class names are made from other class names."""

_UNFIT = re.compile(r"[^A-Za-z0-9_]")
_PARTS = re.compile(r"[0-9]+|[^0-9]+")
_RESERVED = KEYWORDS | {name.lower() for name in FUNCTIONS} | RESERVED_CLASSES | DEVICES
_DIGITS = 8
_KINDS = ("link", "joint", "loop", "sensor")


class Identifier(msgspec.Struct, frozen=True):
    """The Modelica spellings of one link or joint."""

    component: str
    """Begins with a small letter: the component in the robot model."""

    @property
    def type(self) -> str:
        """Begins with a capital letter: the class, and the stem of its file."""
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
    """Return the spelling of a name without regard to others: always an identifier, not always a free one."""
    spelled = _UNFIT.sub("_", name)
    if not spelled[:1].isalpha():
        spelled = f"{kind}_{spelled.removeprefix('_')}"
    if len(spelled) > LONGEST:
        digits = hashlib.sha256(name.encode("utf-8", "surrogatepass")).hexdigest()[:_DIGITS]
        spelled = f"{spelled[: LONGEST - _DIGITS - 1]}_{digits}"
    return spelled[0].lower() + spelled[1:]


def natural_key(name: str) -> tuple[tuple[int, int, str, str], ...]:
    """Return a sort key in which `link10` follows `link9`; distinct names have distinct keys.

    Numbers go before words, by their value, however long they are, and then by the zeros that lead them.
    """
    return tuple(
        (0, len(part.lstrip("0")), part.lstrip("0"), part) if "0" <= part[0] <= "9" else (1, 0, part, part)
        for part in _PARTS.findall(name)
    )


def identify(names: Iterable[ElementKey], taken: Iterable[str] = ()) -> Mapping[ElementKey, Identifier]:
    """Return identifiers of all links, joints and loops; no two are equal when case is folded, none is in `taken`.

    A name keeps its spelling if that is free and not reserved; links go before joints, these before
    loops, names that need no change before others. A name that gives way gets the kind of its element, then a number.
    """
    spelled = {key: spell(key[1], key[0]) for key in names}
    folded, taken = {spelling.lower() for spelling in spelled.values()}, {name.lower() for name in taken}
    if len(folded) == len(spelled) and folded.isdisjoint(taken) and not any(map(is_reserved, folded)):
        return {key: Identifier(spelling) for key, spelling in spelled.items()}  # nearly always: no name gives way
    keys = sorted(spelled, key=lambda key: (_KINDS.index(key[0]), spelled[key] != key[1], natural_key(key[1])))
    used = set(taken)
    result: dict[ElementKey, Identifier] = {}
    for key in keys:
        if _is_free(spelled[key], used):
            used.add(spelled[key].lower())
            result[key] = Identifier(spelled[key])
    numbers: dict[str, int] = {}  # the last number taken, so that many names of one spelling take linear time
    for key in keys:
        if key in result:
            continue
        candidate = stem = f"{spelled[key]}_{key[0]}"
        while not _is_free(candidate, used):
            numbers[stem.lower()] = numbers.get(stem.lower(), 1) + 1
            candidate = f"{stem}_{numbers[stem.lower()]}"
        used.add(candidate.lower())
        result[key] = Identifier(candidate)
    return result


def _is_free(spelled: str, used: set[str]) -> bool:
    return spelled.lower() not in used and not is_reserved(spelled)
