"""The configuration `urdfsync.toml`: its keys, its reader, and the folders of urdfsync itself."""

from urdfsync.project.config.load import find as find
from urdfsync.project.config.load import load as load
from urdfsync.project.config.load import parse as parse
from urdfsync.project.config.names import is_package as is_package
from urdfsync.project.config.names import is_robot_name as is_robot_name
from urdfsync.project.config.paths import explained as explained
from urdfsync.project.config.paths import find_own_library as find_own_library
from urdfsync.project.config.paths import library_folder as library_folder
from urdfsync.project.config.paths import ros_package_path as ros_package_path
from urdfsync.project.config.paths import templates_folder as templates_folder
from urdfsync.project.config.paths import working_folder as working_folder
from urdfsync.project.config.settings import FILE_NAME as FILE_NAME
from urdfsync.project.config.settings import STATE_FOLDER as STATE_FOLDER
from urdfsync.project.config.settings import Config as Config
from urdfsync.project.config.settings import Keys as Keys
from urdfsync.project.config.settings import RobotConfig as RobotConfig
