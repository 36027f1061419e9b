"""Things named by what they say: whether what stands in their place is their new version."""

from __future__ import annotations

import pytest

from urdfsync.merge import merge

BASE = "  connect(a, b);\n  p + q = r;\n  x = 1;\n"

CASES = {
    "an end of a connection": ("connect(a, b)", "connect(a, m)", "connect(g, b)", False),
    "other connections": ("connect(a, b)", "connect(m, n)", "connect(g, h)", True),
    "a connection gone, changed": ("  connect(a, b);\n", "", "  connect(a, g);\n", True),
    "an equation": ("p + q = r", "p + q = 2*r", "p + q = r + s", False),
    "another equation instead": ("p + q = r", "p + q = 2*r", "f(g, h) = i + j", False),
    "other equations": ("p + q = r", "f(m) = n + o", "f(g, h) = i*j", True),
    "an equation gone, another instead": ("  p + q = r;\n", "", "  f(g, h) = i*j;\n", True),
    "a second equation for a variable": ("x = 1", "x = 1;\n  x = m", "x = g", True),
    "two for a variable, of which both change one": ("x = 1", "x = 1;\n  x = m", "x = 2;\n  x = g", True),
    "the same": ("p + q = r", "p + q = 2*r", "p + q = 2 * r", True),
}


@pytest.mark.parametrize(("old", "mine", "generated", "fits"), CASES.values(), ids=CASES)
def test_versions(old: str, mine: str, generated: str, fits: bool) -> None:
    texts = [f"model A\nequation\n{BASE.replace(old, new)}end A;\n" for new in (old, mine, generated)]
    for sides in (texts, [texts[0], *texts[:0:-1]]):
        assert (merge(*sides, is_modelica=True).text is not None) == fits
