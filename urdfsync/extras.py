"""The optional extras of urdfsync, as commands that install them wherever urdfsync itself was installed from."""

PACKAGES = {
    "check": "rumoca scipy",
    "cluster": "distributed",
    "fmu": "fmpy",
    "physics": "pin",
    "plot": "matplotlib",
    "xacro": "xacro",
}
"""The packages of each extra, as in pyproject.toml."""


def install_command(extra: str) -> str:
    """`pip install rumoca`."""
    return f"pip install {PACKAGES[extra]}"
