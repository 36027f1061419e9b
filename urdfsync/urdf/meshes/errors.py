"""What can be wrong with a mesh file."""

from __future__ import annotations

import contextlib
import warnings
from collections.abc import Iterator

NO_TRIANGLES = "it has no triangles"
NOT_FINITE = "it has coordinates that aren't finite numbers"
TOO_LARGE = "its coordinates are too large for single precision"


class MeshError(Exception):
    """A mesh can't be used; the text is the second half of `the mesh … can't be read: it …`."""


@contextlib.contextmanager
def damage_is_an_error() -> Iterator[None]:
    """Turn whatever a broken file makes a reader raise into a MeshError: readers take a sound file for granted.

    Numbers that numpy can't read to the end are an error in all its versions. Lack of memory is told by the caller.
    """
    import numpy as np  # a quarter of a first build of a small robot, which needs MeshError alone

    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.filterwarnings("error", "string or file could not be read", DeprecationWarning)
            yield
    except (MeshError, MemoryError):
        raise
    except ImportError as error:
        raise MeshError(f"a Python package is missing ({error})") from error
    except Exception as error:
        detail = f": {error}" if str(error) else ""
        raise MeshError(f"it is damaged or of another format ({type(error).__name__}{detail})") from error
