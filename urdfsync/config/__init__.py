"""The configuration `urdfsync.toml`: its keys, its reader, and the folders of urdfsync itself."""

from urdfsync.config.load import find as find
from urdfsync.config.load import load as load
from urdfsync.config.load import parse as parse
from urdfsync.config.names import is_package as is_package
from urdfsync.config.names import is_robot_name as is_robot_name
from urdfsync.config.paths import explained as explained
from urdfsync.config.paths import find_own_library as find_own_library
from urdfsync.config.paths import library_folder as library_folder
from urdfsync.config.paths import ros_package_path as ros_package_path
from urdfsync.config.paths import templates_folder as templates_folder
from urdfsync.config.paths import working_folder as working_folder
from urdfsync.config.settings import FILE_NAME as FILE_NAME
from urdfsync.config.settings import STATE_FOLDER as STATE_FOLDER
from urdfsync.config.settings import Config as Config
from urdfsync.config.settings import Keys as Keys
from urdfsync.config.settings import RobotConfig as RobotConfig
