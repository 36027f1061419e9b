"""The optional extras of urdfsync, and the commands that install them, whatever urdfsync was installed from."""

from urdfsync.common.system import IS_WINDOWS

PACKAGES = {
    "check": "rumoca scipy",
    "epanet": "wntr",
    "fmu": "fmpy",
    "mjcf": "mujoco",
    "log": "pyarrow rosbags",
    "physics": "mujoco" if IS_WINDOWS else "pin",  # Pinocchio has no package for Windows
    "plot": "matplotlib",
    "table": "openpyxl pint",
    "xacro": "xacro",
}
"""The packages of each extra, as in pyproject.toml."""


def install_command(extra: str) -> str:
    """`pip install rumoca`."""
    return f"pip install {PACKAGES[extra]}"
