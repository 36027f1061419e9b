"""The version of urdfsync. Modules import it from here: `urdfsync` itself names the whole API."""

__version__ = "1.0.0"
