"""Small robots and damaged bytes; hostile robots are in tests/urdf/test_hostile_sources.py."""

from __future__ import annotations

from random import Random

from support import robots


def small_robot(random: Random) -> str:
    """A right robot of one to seven links, with some of all that a URDF may say."""
    return robots.urdf(robots.dressed(robots.random_robot(random), random))


def damaged(content: bytes, random: Random) -> bytes:
    """Bytes with noise: some changed, a piece gone, repeated or put in."""
    for _ in range(random.choice((1, 1, 3, 20))):
        at, size = random.randint(0, len(content)), random.choice((1, 1, 4, 100))
        kind = random.randrange(5)
        if kind == 0:
            content = content[:at] + random.randbytes(size) + content[at + size :]
        elif kind == 1:
            content = content[:at] + content[at + size :]
        elif kind == 2:
            content = content[:at] + content[at : at + size] * 3 + content[at + size :]
        elif kind == 3:
            content = content[:at] + bytes([random.choice((0, 10, 13, 27, 34, 60, 127, 255))]) + content[at:]
        else:
            content = content[:at]
    return content
