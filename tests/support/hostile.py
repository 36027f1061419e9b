"""Attacks on whoever looks at a stranger's repository: each is a change of a project, committed or not.

Code that runs leaves a file in the folder `outside`, whose files are those that an attack is after.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

from support.meshes import write_hostile
from support.urdfs import joint, limit, link, robot

CONFIGURATION = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\ncross_check = false\n'
MANIFEST = ".urdfsync/robots/arm.toml"
MODEL = ".urdfsync/robots/arm.json"
RECORD = "modelica/Arm/Links/TipParameters.mo"
TEMPLATE = "templates/joint/revolute.mo.jinja"
OUTSIDE = "{outside}"
MINE = "modelica/Other/Mine.mo"
"""A file of the user's own beside the package."""


Attack = Callable[[Path, Path], object]
"""What an attack does to a project; the second folder is the one outside."""


def urdf() -> str:
    """A small robot."""
    turning = joint("turn", "revolute", "base", "tip", axis="0 0 1", inside=[limit()])
    return robot(link("base"), link("tip", 1.0), turning)


def write_project(project: Path) -> None:
    """A project before it is built."""
    (project / "modelica/Other").mkdir(parents=True)
    (project / "urdfsync.toml").write_text(CONFIGURATION)
    (project / "arm.urdf").write_text(urdf())
    (project / MINE).write_text("model Mine\nend Mine;\n")


def make_stale(project: Path) -> None:
    """Give the builds something to do."""
    source = project / "arm.urdf"
    source.write_text(source.read_text().replace('mass value="1.0"', 'mass value="1.5"'))


def _edit(path: Path, old: str, new: str) -> None:
    text = path.read_text()
    assert old in text, f"{path} has no {old!r}"
    path.write_text(text.replace(old, new, 1))


def _configure(project: Path, line: str) -> None:
    with (project / "urdfsync.toml").open("a") as file:
        file.write(f"{line}\n")


def _path(project: Path, outside: Path, path: str) -> str:
    """A path as state has it: from the project's folder; those that begin with `OUTSIDE` lead out of it."""
    return path.replace(OUTSIDE, os.path.relpath(outside, project), 1)


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def _text(place: str, text: str) -> Attack:
    """A text in the place of a file."""
    return lambda project, outside: (project / place).write_text(text)


def _edited(place: str, old: str, new: str) -> Attack:
    """A file with other words in one place."""
    return lambda project, outside: _edit(project / place, old, new)


# 1. Code of the working folder


def _modules(project: Path, outside: Path) -> None:
    """A module of each name that Python and urdfsync import, as source and as compiled code."""
    others = ("urdfsync", "jinja2", "msgspec", "lxml", "numpy", "psutil", "rumoca", "deepdiff", "rich", "sitecustomize")
    text = f"open({str(outside / 'module')!r}, 'w').close()\n"
    for name in (*sys.stdlib_module_names, *others):
        (project / f"{name}.py").write_text(text)
    cache = project / "__pycache__"
    cache.mkdir()
    (cache / f"selectors.{sys.implementation.cache_tag}.pyc").write_bytes(b"code")
    info = project / "evil-1.0.dist-info"
    info.mkdir()
    (info / "entry_points.txt").write_text("[urdfsync.domains]\nevil = selectors:DOMAIN\n")
    (project / "evil.pth").write_text(f"import os; os.mkdir({str(outside / 'pth')!r})\n")


def _domain(project: Path, outside: Path) -> None:
    """A domain that only a module of the repository has."""
    _modules(project, outside)
    _configure(project, 'domain = "evil"')


# 2. Templates


def _template(project: Path, text: str, name: str = TEMPLATE) -> None:
    file = project / name
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)
    if "templates =" not in (project / "urdfsync.toml").read_text():
        _configure(project, 'templates = "templates"')


def _template_escape(project: Path, outside: Path) -> None:
    _template(project, f"<< cycler.__init__.__globals__.os.popen('touch {outside}/template').read() >>\n")


def _template_without_end(project: Path, outside: Path) -> None:
    _template(project, "<% macro m() %><< m() >><% endmacro %><< m() >>", "templates/link/model.mo.jinja")


def _template_link(project: Path, outside: Path) -> None:
    _template(project, "", "templates/robot/model.mo.jinja")
    (project / "templates/robot/model.mo.jinja").unlink()
    (project / "templates/robot/model.mo.jinja").symlink_to(outside / "victim.mo")


def _template_fifo(project: Path, outside: Path) -> None:
    _template(project, "")
    (project / TEMPLATE).unlink()
    os.mkfifo(project / TEMPLATE)


# 3. The journal


def _journal(path: str) -> Attack:
    """A journal half way through the change of a file, with the file's new content beside it."""

    def make(project: Path, outside: Path) -> None:
        folder = project / ".urdfsync/journal"
        folder.mkdir(exist_ok=True)
        steps = [{"path": _path(project, outside, path), "old": None, "new": _digest(b"evil")}]
        journal = folder / "apply.json"
        values = {"robot": "arm", "token": "12", "steps": steps, "made": [], "emptied": ["modelica/Other"], "format": 3}
        journal.write_text(json.dumps({**values, "inode": 1, "written": 1}))
        beside = (project / path).parent
        if not path.startswith((OUTSIDE, ".git/")):
            beside.mkdir(parents=True, exist_ok=True)
            (beside / f"{Path(path).name}.12.urdfsync-tmp").write_bytes(b"evil")

    return make


# 4. The manifest


def _manifest_file(path: str) -> Attack:
    """A manifest that has a file as one of urdfsync's, with the right hash, which is no longer generated."""

    def make(project: Path, outside: Path) -> None:
        victim = _path(project, outside, path)
        content = (project / victim).read_bytes()
        name = os.path.relpath(victim, "modelica/Arm")
        entry = f'\n[files."{name}"]\nbase = "{_digest(content)}"\nowner = "link gone"\nrole = "model"\n'
        with (project / MANIFEST).open("a") as file:
            file.write(entry)

    return make


def _manifest_folder(folder: str) -> Attack:
    """A manifest whose package was elsewhere before."""

    def make(project: Path, outside: Path) -> None:
        _edit(project / MANIFEST, 'folder = "modelica/Arm"', f"folder = {json.dumps(_path(project, outside, folder))}")

    return make


def _former_folder(project: Path, outside: Path) -> None:
    """A manifest and a list of folders, both of which say that the user's package is a former place of urdfsync's."""
    _manifest_folder("modelica/Other")(project, outside)
    entry = {"modelica/Other": ["Mine.mo"], "arm": ["modelica/Other"]}
    file = project / ".urdfsync/folders.json"
    file.write_text(json.dumps({"folders": entry, "inode": 1, "written": 1}))
    status = file.stat()  # as it was where the stranger wrote it
    file.write_text(json.dumps({"folders": entry, "inode": status.st_ino, "written": status.st_mtime_ns}))


# 5. Links, and outputs elsewhere


def _link(place: str, target: str) -> Attack:
    """A link in the place of a file or folder, to one outside; what was there is at its end."""

    def make(project: Path, outside: Path) -> None:
        path = project / place
        if path.is_dir():
            shutil.copytree(path, outside / target, dirs_exist_ok=True)
            shutil.rmtree(path)
        elif path.exists():
            path.unlink()
        path.parent.mkdir(parents=True, exist_ok=True)
        path.symlink_to(outside / target)

    return make


def _journal_link(project: Path, outside: Path) -> None:
    """A link in the place of the journals, to a folder of the user's whose files could be those of another urdfsync."""
    for name in ("notes", "plans"):
        (outside / "folder" / f"{name}.json").write_text(f'"{name}"')
    _link(".urdfsync/journal", "folder")(project, outside)


def _fifo(place: str) -> Attack:
    def make(project: Path, outside: Path) -> None:
        (project / place).parent.mkdir(parents=True, exist_ok=True)
        (project / place).unlink(missing_ok=True)
        os.mkfifo(project / place)

    return make


def _output_outside(project: Path, outside: Path) -> None:
    _configure(project, f"output = {json.dumps(os.path.relpath(outside, project))}")


# 6. Meshes and large files


def _show(project: Path, *names: str) -> None:
    """Let the robot show meshes."""
    shapes = "".join(f'<visual><geometry><mesh filename="{name}"/></geometry></visual>' for name in names)
    text = (project / "arm.urdf").read_text()
    (project / "arm.urdf").write_text(text.replace('<link name="base"/>', f'<link name="base">{shapes}</link>'))


def _meshes(project: Path, outside: Path) -> None:
    """Meshes whose readers would not end, or would take all memory."""
    names = ("expression.off", "list.ply", "accessor.gltf", "corners.obj", "deep.dae")
    for name in names:
        write_hostile(project, name)
    _show(project, *names)


def _special_meshes(project: Path, outside: Path) -> None:
    os.mkfifo(project / "pipe.obj")
    _large("sparse.stl")(project, outside)
    _show(project, "pipe.obj", "sparse.stl")


def _large(place: str) -> Attack:
    """A file without content that is too large to be read."""

    def make(project: Path, outside: Path) -> None:
        with (project / place).open("wb") as file:
            file.truncate(200_000_000)  # git reads it, too

    return make


# 8. Texts


def _base_not_text(project: Path, outside: Path) -> None:
    """What is no text, kept under the hash that the manifest has for a file."""
    text = b"\xff\xfe"
    lines = (project / MANIFEST).read_text().splitlines(keepends=True)
    entry = f'[files."{Path(RECORD).relative_to("modelica/Arm").as_posix()}"]\n'
    at = lines.index(entry)
    changed = next(number for number in range(at, len(lines)) if lines[number].startswith("base = "))
    lines[changed] = f'base = "{_digest(text)}"\n'
    (project / MANIFEST).write_text("".join(lines))
    (project / ".urdfsync/base/arm").mkdir(parents=True, exist_ok=True)
    (project / ".urdfsync/base/arm" / _digest(text)).write_bytes(text)


def _entities(project: Path, outside: Path) -> None:
    declared = "".join(f'<!ENTITY e{n + 1} "{f"&e{n};" * 10}">' for n in range(12))
    head = f'<!DOCTYPE robot [<!ENTITY e0 "ha"><!ENTITY x SYSTEM "file://{outside}/victim.mo">{declared}]>'
    text = (project / "arm.urdf").read_text().replace('name="base"', 'name="&e12;&x;"')
    (project / "arm.urdf").write_text(head + text.partition("?>")[2])


def _deep_chain(project: Path, outside: Path) -> None:
    """A robot that is a chain of joints, deeper than Python calls."""
    names = [f"l{number}" for number in range(1050)]
    joints = [joint(f"j{n}", "fixed", *names[n : n + 2]) for n in range(len(names) - 1)]
    (project / "arm.urdf").write_text(robot(*map(link, names), *joints))


def _terminal_names(project: Path, outside: Path) -> None:
    """Names that a terminal would obey: as an 8-bit control sequence, and as text that runs backwards."""
    text = urdf().replace('"tip"', '"\x9b31m\u202etip"').replace('"turn"', '"&#x9b;2J\u2028turn"')
    (project / "arm.urdf").write_text(text)


def _terminal_files(project: Path, outside: Path) -> None:
    """Files and robots whose names a terminal would obey."""
    (project / "\x1b]0;evil\x07.urdf").write_text(urdf())
    (project / "\x1b[2J.xml").write_text("no robot")
    shutil.copy(project / MANIFEST, project / ".urdfsync/robots/\x1b[31m.toml")
    _edit(project / "urdfsync.toml", '"arm.urdf"', '"\\u001b]0;evil\\u0007.urdf"')


# Git


def _bare_repository(project: Path, outside: Path) -> None:
    """A repository among the files, whose settings name a program that git calls."""
    for folder in ("refs/heads", "objects"):
        (project / folder).mkdir(parents=True)
        (project / folder / "keep").write_text("")
    (project / "HEAD").write_text("ref: refs/heads/main\n")
    program = f"touch {outside}/git; false"
    settings = f'repositoryformatversion = 0\nbare = false\nworktree = "."\nfsmonitor = "{program}"\n'
    (project / "config").write_text(f"[core]\n{settings}")


def _git_files(project: Path, outside: Path) -> None:
    """Attributes and modules that name programs, which git only runs where its own settings define them."""
    (project / ".gitattributes").write_text("* filter=evil diff=evil merge=evil\n")
    (project / ".gitmodules").write_text(f'[submodule "x"]\npath = x\nurl = "ext::sh -c \'touch {outside}/git\'"\n')


COMMITTED: Mapping[str, Attack] = {
    "modules": _modules,
    "a domain of the repository": _domain,
    "a template that leaves the sandbox": _template_escape,
    "a template without end": _template_without_end,
    "a template that is a link": _template_link,
    "a journal about git's hooks": _journal(".git/hooks/pre-commit"),
    "a journal about a file outside": _journal(f"{OUTSIDE}/victim.mo"),
    "a journal about the user's file": _journal(MINE),
    "a manifest with a file outside": _manifest_file(f"{OUTSIDE}/victim.mo"),
    "a manifest with the user's file": _manifest_file(MINE),
    "a manifest with the configuration": _manifest_file("urdfsync.toml"),
    "a manifest of a package outside": _manifest_folder(OUTSIDE),
    "a manifest of the user's package": _manifest_folder("modelica/Other"),
    "a list of former folders": _former_folder,
    "a deep list of former folders": _text(".urdfsync/folders.json", '{"x":' + "[" * 200_000),
    "state that is a link": _link(".urdfsync", "state"),
    "manifests that are a link": _link(".urdfsync/robots", "state"),
    "a manifest that is a link": _link(MANIFEST, "victim.mo"),
    "a journal that is a link": _link(".urdfsync/journal", "folder"),
    "journals that are the user's files": _journal_link,
    "a temporary journal that is a link": _link(".urdfsync/journal/new.urdfsync-tmp", "victim.mo"),
    "bases that are a link": _link(".urdfsync/base/arm", "folder"),
    "an answer that is a link": _link(".urdfsync/stamp", "victim.mo"),
    "a lock that is a link": _link(".urdfsync/lock", "victim.mo"),
    "conflicts that are a link": _link(".urdfsync/conflicts", "folder"),
    "a drawing that is a link": _link(".urdfsync/svg", "folder"),
    "a package that is a link": _link("modelica/Arm", "folder"),
    "an output folder that is a link": _link("modelica", "folder"),
    "an output that is a link": _link(RECORD, "victim.mo"),
    "an output folder outside": _output_outside,
    "a base that is no text": _base_not_text,
    "a deep model": _text(MODEL, '{"snapshot":' + "[" * 200_000),
    "a deep manifest": _text(MANIFEST, "a = " + "[" * 200_000),
    "entities": _entities,
    "a deep source": _text("arm.urdf", "<robot>" + "<link>" * 100_000 + "</link>" * 100_000 + "</robot>"),
    "a long chain": _deep_chain,
    "huge numbers": _edited("arm.urdf", 'mass value="1.5"', f'mass value="{"9" * 100_000}"'),
    "names for the terminal": _terminal_names,
    "files for the terminal": _terminal_files,
    "a manifest for the terminal": _edited(MANIFEST, 'tip = "tip"', '"\\u001b[31mtip" = "\\u009b2J"'),
    "a repository in the repository": _bare_repository,
    "attributes of git": _git_files,
    "meshes without end": _meshes,
}
"""Those that git can carry to somebody else."""
LOCAL: Mapping[str, Attack] = {
    "a template that is a FIFO": _template_fifo,
    "a source that is a FIFO": _fifo("arm.urdf"),
    "a configuration that is a FIFO": _fifo("urdfsync.toml"),
    "a manifest that is a FIFO": _fifo(MANIFEST),
    "an answer that is a FIFO": _fifo(".urdfsync/stamp"),
    "a lock that is a FIFO": _fifo(".urdfsync/lock"),
    "an output that is a FIFO": _fifo(RECORD),
    "a source of 200 MB": _large("arm.urdf"),
    "a configuration of 200 MB": _large("urdfsync.toml"),
    "meshes that are a FIFO and 200 MB": _special_meshes,
}
ATTACKS = {**COMMITTED, **LOCAL}

APART = {
    "a domain of the repository",
    "state that is a link",
    "manifests that are a link",
    "a manifest that is a link",
    "a manifest of the user's package",
    "a list of former folders",
    "a journal that is a link",
    "journals that are the user's files",
    "a package that is a link",
    "an output folder that is a link",
    "a deep manifest",
    "entities",
    "a deep source",
    "a long chain",
    "files for the terminal",
    "a repository in the repository",
    "meshes without end",
}
"""Attacks that would hide most others of a project, or that it has no place for."""
