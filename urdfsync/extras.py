"""The optional extras of urdfsync, as commands that install them wherever urdfsync itself was installed from."""

PACKAGES = {
    "check": "rumoca scipy",
    "cluster": "distributed",
    "epanet": "wntr",
    "fmu": "fmpy",
    "physics": "pin",
    "plot": "matplotlib",
    "table": "openpyxl pint",
    "xacro": "xacro",
}
"""The packages of each extra, as in pyproject.toml."""


def install_command(extra: str) -> str:
    """`pip install rumoca`."""
    return f"pip install {PACKAGES[extra]}"
