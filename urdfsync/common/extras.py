"""The optional extras of urdfsync, and the commands that install them, whatever urdfsync was installed from."""

PACKAGES = {
    "check": "rumoca scipy",
    "epanet": "wntr",
    "fmu": "fmpy",
    "mjcf": "mujoco",
    "log": "pyarrow rosbags",
    "physics": "pin",
    "plot": "matplotlib",
    "table": "openpyxl pint",
    "xacro": "xacro",
}
"""The packages of each extra, as in pyproject.toml."""


def install_command(extra: str) -> str:
    """`pip install rumoca`."""
    return f"pip install {PACKAGES[extra]}"
