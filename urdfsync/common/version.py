"""The version of urdfsync. Modules import it from here: `urdfsync` itself names the whole API."""

__version__ = "0.1.0"
