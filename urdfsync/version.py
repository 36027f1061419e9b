"""The version of urdfsync, for modules that must not import the package's face: that names the whole API."""

__version__ = "0.1.0"
