"""Keep Modelica models in step with URDF sources."""

TYPE_CHECKING = False  # that of `typing` takes 2 of the 12 ms of the up-to-date check
if TYPE_CHECKING:
    from urdfsync.api import Results as Results
    from urdfsync.api import load as load
    from urdfsync.api.builds import adopt as adopt
    from urdfsync.api.builds import build as build
    from urdfsync.api.checks import check as check
    from urdfsync.api.edits import edits as edits
    from urdfsync.api.simulations import export_fmu as export_fmu
    from urdfsync.api.simulations import simulate as simulate
    from urdfsync.api.sources import record as record
    from urdfsync.api.statuses import status as status
    from urdfsync.api.versions import diff as diff
    from urdfsync.config import library_folder as library_folder
    from urdfsync.diagnostics import UrdfsyncError as UrdfsyncError

__version__ = "0.1.0"

_PLACES = {
    "api": ("Results", "load"),
    "api.builds": ("adopt", "build"),
    "api.checks": ("check",),
    "api.edits": ("edits",),
    "api.simulations": ("export_fmu", "simulate"),
    "api.sources": ("record",),
    "api.statuses": ("status",),
    "api.versions": ("diff",),
    "config": ("library_folder",),
    "diagnostics": ("UrdfsyncError",),
}
"""The names of the API by their modules, each of which is loaded when somebody asks for one: a build takes 200 ms."""
__all__ = ("__version__", *(name for names in _PLACES.values() for name in names))

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        """Load a name of the API."""
        for place, names in _PLACES.items():
            if name in names:
                import importlib  # the up-to-date check does without

                return getattr(importlib.import_module(f"urdfsync.{place}"), name)
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
