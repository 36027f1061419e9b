"""The search for reference cycles is held back where it is asked for, and nowhere else."""

from __future__ import annotations

import gc
import weakref

import pytest

from urdfsync import garbage
from urdfsync.domain import Role
from urdfsync.manifest import Generator, Manifest, Source, dumps
from urdfsync.plan import FileRecord


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


class _Cycle:
    def __init__(self) -> None:
        self.itself = self


def test_a_search_finds_what_was_made_lately() -> None:
    garbage.search()
    with garbage.held_back():
        gone = weakref.ref(_Cycle())
        assert gone() is not None
        garbage.search()
        assert gone() is None


def test_a_manifest_goes_when_nothing_refers_to_it() -> None:
    """One per rebuild is made by the daemon, with thousands of records."""
    source, generator = Source("arm.urdf", "", ""), Generator("urdf", 1, "")
    files = {"Arm/Arm.mo": FileRecord("robot", Role.MODEL, "hash")}
    with garbage.held_back():
        gc.collect()
        made = Manifest(package="Arm", class_="Arm", folder="Arm", source=source, generator=generator, files=files)
        dumps(made)
        assert made.recorded.recorded.plain
        del made
        gc.set_debug(gc.DEBUG_SAVEALL)
        try:
            gc.collect()
            assert not [found for found in gc.garbage if isinstance(found, Manifest)]
        finally:
            gc.set_debug(0)
            gc.garbage.clear()
