"""Merges that take time: the others are in `catalogue/`."""

from __future__ import annotations

from urdfsync.merge import merge


def test_many_comments_in_a_row_end() -> None:
    """One pattern for all of them tried each end of each comment with all others: minutes for 30 comments."""
    base = "model A\n  Real x = 1;\n" + 200 * "  /* note */\n" + "  Real y = 1;\nend A;\n"
    merged = merge(base, base.replace("x = 1", "x = 2"), base.replace("y = 1", "y = 3"), is_modelica=True)
    assert merged.text == base.replace("x = 1", "x = 2").replace("y = 1", "y = 3")


def test_equations_too_many_to_compare_each_with_each_merge_by_lines() -> None:
    """A thousand that both sides replaced: nothing is lost, nothing is taken for another in silence."""
    texts = ("".join(f"  x{i} + {n} = y*{i + n};\n" for i in range(1_000)) for n in range(3))
    base, mine, generated = (f"model A\nequation\n{text}end A;\n" for text in texts)
    assert merge(base, mine, generated, is_modelica=True).text is None
