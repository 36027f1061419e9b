"""URDF names to Modelica identifiers: one rule, injective, a function of the set of names alone.

Links and joints of a robot share one namespace, because both become components of the robot model.
`docs/naming.md` states the rule for users.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterable, Mapping

from urdfsync.modelica import KEYWORDS

Key = tuple[str, str]
"""Kind (`link` or `joint`) and URDF name."""

BUILT_IN = frozenset(
    "abs acos actualstream array asin assertionlevel atan atan2 backsample boolean cardinality cat ceil "
    "change clock complex cos cosh cross delay diagonal div edge exp externalobject fill floor getinstancename "
    "hold homotopy identity instream integer interval inverse ln log log10 linspace matrix max min mod modelica "
    "modelicaservices ndims noclock noevent ones outerproduct pre previous product promote real reinit rem rooted "
    "sample scalar semilinear shiftsample sign sin sinh size skew smooth spatialdistribution sqrt stateselect "
    "string subsample sum supersample symmetric tan tanh terminal terminate time transpose vector zeros "
    "connections constants urdfsync visualization2".split()
)

GENERATED = frozenset(
    "animation checklimits fixedstart frame_a frame_b joints links m parameters phi_start resources "
    "rotationalaxis rotationalrange rotationalsupport s_start showcollisions translationalaxis translationalrange "
    "translationalsupport v_start w_start world".split()
)
"""Names, folded to lower case, that robot models use beside those of links and joints."""

RESERVED_SUFFIXES = ("parameters", "run", "test")
"""Endings, folded to lower case, by which class names are made from other class names."""

DERIVED_SUFFIXES = ("", "axis", "frame", "mimic")
"""Endings, folded to lower case, of the names in the robot model that come with a link or joint."""


@dataclasses.dataclass(frozen=True, slots=True)
class Identifier:
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
    """Whether an identifier would collide with the language, a library or generated text."""
    folded = spelling.lower()
    return folded in KEYWORDS | BUILT_IN | GENERATED or folded.endswith(RESERVED_SUFFIXES)


def spell(name: str, kind: str) -> str:
    """The spelling that a name gets if nothing else wants it: always an identifier, not always a free one."""
    spelled = re.sub(r"[^A-Za-z0-9_]", "_", name)
    if not spelled[:1].isalpha():
        spelled = f"{kind}_{spelled}" if not spelled.startswith("_") else f"{kind}{spelled}"
    return spelled[0].lower() + spelled[1:]


def natural_key(name: str) -> tuple[tuple[int, int, str], ...]:
    """Sort key in which `link10` follows `link9`; total: distinct names have distinct keys."""
    parts = re.findall(r"[0-9]+|[^0-9]+", name)
    return tuple((0, int(p), p) if "0" <= p[0] <= "9" else (1, 0, p) for p in parts)


def identify(names: Iterable[Key], taken: Iterable[str] = ()) -> Mapping[Key, Identifier]:
    """Identifiers of all links and joints; no two are equal when case is folded, none is in `taken`.

    A name keeps its spelling if that is free and not reserved; links go before joints, names that
    need no change before others. What must give way gets `_link` or `_joint`, then a number.
    """
    keys = sorted(set(names), key=lambda key: (key[0] != "link", spell(key[1], key[0]) != key[1], natural_key(key[1])))
    used = {name.lower() for name in taken}
    result: dict[Key, Identifier] = {}
    for key in keys:
        spelled = spell(key[1], key[0])
        if _is_free(spelled, used):
            result[key] = _take(spelled, used)
    for key in keys:
        if key not in result:
            result[key] = _take(_give_way(spell(key[1], key[0]), key[0], used), used)
    return result


def _is_free(spelled: str, used: set[str]) -> bool:
    return not is_reserved(spelled) and used.isdisjoint(spelled.lower() + suffix for suffix in DERIVED_SUFFIXES)


def _take(spelled: str, used: set[str]) -> Identifier:
    used.update(spelled.lower() + suffix for suffix in DERIVED_SUFFIXES)
    return Identifier(spelled)


def _give_way(spelled: str, kind: str, used: set[str]) -> str:
    candidate, number = f"{spelled}_{kind}", 1
    while not _is_free(candidate, used):
        number += 1
        candidate = f"{spelled}_{kind}_{number}"
    return candidate
