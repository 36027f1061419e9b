"""Keep Modelica models in step with URDF sources."""

# ruff: noqa: F403, F405 - type checkers find the names below in `api`
from urdfsync.common.version import __version__ as __version__

__all__ = ["Results", "UrdfsyncError", "build", "check", "diff", "edits", "library_folder", "load", "record"]
__all__ += ["excite", "identify", "simulate", "status", "vary"]

TYPE_CHECKING = False  # importing it from `typing` takes 2 of the 12 ms of the up-to-date check
if TYPE_CHECKING:
    from urdfsync.api import *
else:

    def __getattr__(name: str) -> object:
        """Load a name of the API when it is needed: importing `api` takes 200 ms."""
        if name in __all__:
            import importlib  # saves the up-to-date check an import

            return getattr(importlib.import_module("urdfsync.api"), name)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")

    def __dir__() -> list[str]:
        """Return names for completion in notebooks and consoles."""
        return [*globals(), *__all__]
