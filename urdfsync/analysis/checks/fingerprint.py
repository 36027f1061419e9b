"""One hash of all inputs of a result: `check`, the check after a build and `simulate` remember results by this hash."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence

import msgspec

from urdfsync.analysis.checks import compilers, libraries, package
from urdfsync.analysis.checks.cache import digest
from urdfsync.analysis.checks.compilers.compiler import Tool
from urdfsync.analysis.checks.contents import RESOURCES, content_hash, package_texts
from urdfsync.analysis.checks.results import CheckOptions
from urdfsync.common.dependencies import program
from urdfsync.common.diagnostics import UrdfsyncError
from urdfsync.common.files import shown
from urdfsync.domain import registry
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.sources import source
from urdfsync.modelica.names import LIBRARY
from urdfsync.project.config import Config, RobotConfig, find_own_library
from urdfsync.project.state.store import Store


def result_key(
    robot: RobotConfig,
    tools: Sequence[Tool],
    needed: libraries.Libraries,
    *facts: object,
    hashed: Callable[..., str] = content_hash,
) -> str | None:
    """Return the key of a result: a hash of `facts` and of all other inputs.

    `hashed` may be a `content_hash` that remembers its results, for one look at many robots: they share libraries.

    The other inputs are urdfsync with its library, the domain's code, Python with its packages, the compilers and the
    Modelica libraries.

    None if an input can't be read: then the result must not be remembered.
    """
    own = find_own_library(LIBRARY, robot.target.package)
    places = {**needed.others, **({LIBRARY: own} if own else {})}
    if any(compilers.COMPILERS[tool.name].HAS_STANDARD_LIBRARY for tool in tools):
        places |= {str(path): path for path in libraries.standard_libraries()}
    try:
        return digest(
            *(sys.platform, program.contents_hash(*registry.code(robot.domain))),
            [compilers.state(tool, hashed) for tool in tools],
            [(name, str(path), hashed(path)) for name, path in sorted(places.items())],
            # the compiler gets copies of these libraries without resources
            [(str(path), hashed(path, (RESOURCES,))) for path in needed.standard.values()],
            *(str(needed.problem), robot.target, robot.domain),
            *facts,
        )
    except (UrdfsyncError, OSError):
        return None


def fingerprint(
    config: Config, robot: RobotConfig, options: CheckOptions, hashed: Callable[..., str] = content_hash
) -> str | None:
    """Return the key of the check of a package in step; None if an input can't be read. `hashed` as in `result_key`.

    This reads all inputs, and may run xacro or a translator. It writes nothing.
    """
    domain = registry.domain(robot.domain)
    try:
        texts = package_texts(robot.folder)
        around = package.files_around(config, robot, texts)
        users = package.users_files(config, robot)
        every = [*texts.values(), *around.values(), *users.values()]
        needed = libraries.find_libraries(config, robot, every, [name for name, _ in domain.uses(robot.options)])
        others = {**needed.others, **package.users_models(robot, users).libraries}
        request = BuildOptions(dry=True, package_paths=options.package_paths)
        text = source.read_source(config, robot, Store(config.root), request)
        templates = source.templates(config, robot, domain).digest
    except Exception:  # noqa: BLE001 - the check meets this error, too, and reports it
        return None
    return result_key(
        robot,
        options.tools,
        msgspec.structs.replace(needed, others=others),
        *(options.physics, robot.options, text.content, text.companions, templates),
        shown(robot.folder),  # findings name files relative to the working folder
        *(sorted(files.items()) for files in (texts, around, users)),
        hashed=hashed,
    )
