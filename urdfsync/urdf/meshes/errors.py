"""What can be wrong with a mesh file, and how the libraries that read such files are kept strict and quiet."""

from __future__ import annotations

import contextlib
import logging
import warnings
from collections.abc import Iterator

import numpy as np

_SEEN = (
    ArithmeticError,
    AssertionError,
    AttributeError,
    LookupError,
    MemoryError,
    NameError,
    NotImplementedError,
    RecursionError,
    TypeError,
    ValueError,
    DeprecationWarning,  # see `guarded`
)
"""What trimesh and pycollada have been seen to raise for broken files, whose structure they take for granted."""


class MeshError(Exception):
    """A mesh can't be used; the text is the second half of `the mesh … can't be read: it …`."""


@contextlib.contextmanager
def guarded() -> Iterator[None]:
    """Calls to a library that reads meshes: whatever it raises for a broken file becomes a MeshError.

    Numbers that numpy can't read to the end are an error in all its versions, and trimesh's log is silent.
    """
    log = logging.getLogger("trimesh")
    level = log.level
    log.setLevel(logging.CRITICAL + 1)
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.filterwarnings("error", "string or file could not be read", DeprecationWarning)
            yield
    except ImportError as error:
        raise MeshError(f"a Python package is missing ({error})") from error
    except _SEEN as error:
        detail = f": {error}" if str(error) else ""
        raise MeshError(f"it is damaged or of another format ({type(error).__name__}{detail})") from error
    finally:
        log.setLevel(level)
