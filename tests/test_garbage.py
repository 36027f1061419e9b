"""The search for reference cycles is held back where it is asked for, and nowhere else."""

from __future__ import annotations

import gc

import pytest

from urdfsync import garbage


def test_the_search_goes_on_after_the_outermost_end() -> None:
    with garbage.held_back():
        with garbage.held_back():
            assert not gc.isenabled()
        assert not gc.isenabled()
    assert gc.isenabled()


def test_the_search_goes_on_after_an_error() -> None:
    with pytest.raises(KeyError), garbage.held_back():
        raise KeyError
    assert gc.isenabled()
