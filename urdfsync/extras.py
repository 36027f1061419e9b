"""The optional extras of urdfsync, as commands that install them wherever urdfsync itself was installed from."""

PACKAGES = {
    "check": ("rumoca",),
    "cluster": ("distributed",),
    "omc": ("OMPython",),
    "physics": ("pin",),
}
"""The packages of each extra, as in pyproject.toml."""


def install_command(*extras: str) -> str:
    """`pip install rumoca`."""
    return " ".join(["pip install", *(name for extra in extras for name in PACKAGES[extra])])
