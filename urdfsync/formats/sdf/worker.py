"""The program that translates one SDF into URDF, within limits; `engine.sources.expansion` starts it."""

from __future__ import annotations

import os
from pathlib import Path

import msgspec

from urdfsync.common.spelling import nearest
from urdfsync.engine.sources.exchange import Answer, Request, serve
from urdfsync.engine.sources.ros_packages import Packages
from urdfsync.formats.sdf.document import SdfDocument
from urdfsync.formats.sdf.frames import Frame, Frames
from urdfsync.formats.sdf.joints import FIXED
from urdfsync.formats.sdf.robot import translated
from urdfsync.formats.translation import program
from urdfsync.formats.translation.files import Files
from urdfsync.formats.translation.writer import listed, write


def translate(request: Request) -> Answer:
    """Translate a file, or compare its translation."""
    folders = (request.folder, os.path.dirname(request.source), *request.package_paths)  # noqa: PTH120
    files = Files(request.contents, folders)
    document = SdfDocument(request.source, files, request.package_paths)

    def translate_or_compare() -> Answer:
        if request.text:
            from urdfsync.formats.sdf import comparison  # a late import saves translations a second

            packages = Packages(list(map(Path, request.package_paths)), Path(request.source))
            compared, differences = comparison.compare(files, packages, request.source, request.text)
            return Answer(compared=compared, differences=differences, uncompared=(comparison.UNCOMPARED,))
        frames = Frames(document)
        model = choose_model(frames, request.arguments.get("model", ""))
        return Answer(*write(translated(frames, model)))

    made = program.answer(request, files, "sdf", ("model",), translate_or_compare)
    return msgspec.structs.replace(made, packages=document.packages.places())


def choose_model(frames: Frames, name: str) -> Frame:
    """Return the model with a name; without one, the only model with a joint that moves. Raises TranslationError."""
    document, top = frames.document, frames.world
    models = {model.name: model for model in top.models}
    if name:
        if name not in models:
            near = nearest(name, list(models))
            hint = f"perhaps {near!r} is meant" if near else f"choose one of {listed(list(models))}"
            raise document.fault(top.element, f"there is no model {name!r}", hint)
        return models[name]
    moving = [
        key
        for key, model in models.items()
        if any(part.element.get("type") not in FIXED for part in model.of_kind("joint"))
    ]
    robots = [key for key in moving if not document.flag(models[key].static_holder, "static")] or moving
    if len(robots) == 1:
        return models[robots[0]]
    if robots:
        message = f"the file has {len(robots)} robots: {listed(robots)}"
        hint = f'choose one by `arguments = {{ model = "{robots[0]}" }}` (`init FILE model:={robots[0]}`)'
        raise document.fault(top.element, message, hint)
    if frames.missing:
        raise frames.missing[0]
    what = "no model has a joint that moves" if len(models) > 1 else "the model has no joint: nothing in it moves"
    raise document.fault(top.element, what if models else "the file has no model", "name the file that has the robot")


def main() -> None:
    """Translate the file that stdin names."""
    serve(translate, "sdf")


if __name__ == "__main__":
    main()
