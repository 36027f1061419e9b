"""Turns URDF names into Modelica identifiers: an identifier depends only on the name of its element.

Twins are the exception: elements of equal names, or of names that differ only in case. Links and joints of a robot
share one namespace, because both become components of the robot model. `docs/naming.md` states the rule for users.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

import msgspec

from urdfsync.domain import ElementKey
from urdfsync.modelica.identifiers import hashed, is_free, tell_apart

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

RESERVED_SUFFIXES = ("parameters", "run", "test")
"""Endings of generated class names, in lower case."""

_PLAIN = re.compile(r"[A-Za-z](?:[_-]?[A-Za-z0-9])*[_-]?")
"""Names that need no hash: without two underscores or hyphens in a row."""
_PARTS = re.compile(r"[0-9]+|[^0-9]+")


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


def spell(name: str, kind: str) -> str:
    """Return the identifier of an element without a twin: the name, or the usable part of the name with a hash."""
    if name == "world":  # the root of nearly all sources in MJCF and SDF
        return f"{name}{kind.capitalize()}"
    plain = name.replace("-", "__")
    folded = plain.lower()
    is_generated = folded in GENERATED or folded.endswith(RESERVED_SUFFIXES)
    if _PLAIN.fullmatch(name) and is_free(plain) and not is_generated:
        return plain[0].lower() + plain[1:]
    return hashed(name, kind)


def natural_key(name: str) -> tuple[tuple[int, int, str, str], ...]:
    """Return a sort key in which `link10` follows `link9`; distinct names have distinct keys."""
    return tuple(
        (0, len(part.lstrip("0")), part.lstrip("0"), part) if "0" <= part[0] <= "9" else (1, 0, part, part)
        for part in _PARTS.findall(name)
    )


def identify(names: Iterable[ElementKey], taken: Iterable[str] = ()) -> Mapping[ElementKey, Identifier]:
    """Return identifiers of all links, joints and loops, as `tell_apart` does."""
    spelled = {key: spell(key[1], key[0]) for key in names}
    return {key: Identifier(spelling) for key, spelling in tell_apart(spelled, taken).items()}
