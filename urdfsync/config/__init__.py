"""The configuration `urdfsync.toml`: what a user may set, how it is read, and the folders of urdfsync itself."""

from urdfsync.config.load import find, load, parse
from urdfsync.config.names import is_robot_name
from urdfsync.config.paths import (
    find_own_library,
    library_folder,
    read_source,
    ros_package_path,
    templates_folder,
    working_folder,
)
from urdfsync.config.settings import FILE_NAME, STATE_FOLDER, CheckConfig, Config, Keys, RobotConfig
from urdfsync.files import shown

__all__ = [
    "FILE_NAME",
    "STATE_FOLDER",
    "CheckConfig",
    "Config",
    "Keys",
    "RobotConfig",
    "find",
    "find_own_library",
    "is_robot_name",
    "library_folder",
    "load",
    "parse",
    "read_source",
    "ros_package_path",
    "shown",
    "templates_folder",
    "working_folder",
]
