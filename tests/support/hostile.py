"""Attacks on users of a stranger's repository: each is a change of a project, committed or not.

Code that runs leaves a file in the folder `outside`; attacks try to change the files in this folder.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
import os
import re
import shutil
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

from support.meshes import write_hostile
from support.urdfs import joint, limit, link, robot
from urdfsync.project.state.expansion import Expansion, dumps

CONFIGURATION = '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n'
MANIFEST = ".urdfsync/robots/arm.state"
RECORD = "modelica/Arm/Links/TipParameters.mo"
MINE = "modelica/Other/Mine.mo"
"""A file of the user's own beside the package."""
_MODULES = (
    *sys.stdlib_module_names,
    *("urdfsync", "jinja2", "msgspec", "lxml", "numpy", "psutil", "rumoca", "rich", "sitecustomize", "pip"),
)


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
    """Change the sources, so that builds have to write."""
    source = project / "arm.urdf"
    source.write_text(source.read_text().replace('mass value="1.0"', 'mass value="1.5"'))


@dataclasses.dataclass(frozen=True)
class Stranger:
    """The attacker of a project: each method is an attack, or a part of attacks. Paths are below the project."""

    project: Path
    outside: Path

    def write(self, place: str, content: str | bytes) -> None:
        path = self.project / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())

    def edit(self, place: str, old: str, new: str) -> None:
        text = (self.project / place).read_text()
        assert old in text, f"{place} has no {old!r}"
        (self.project / place).write_text(text.replace(old, new, 1))

    def append(self, place: str, line: str) -> None:
        with (self.project / place).open("a") as file:
            file.write(f"{line}\n")

    def configure(self, line: str) -> None:
        self.append("urdfsync.toml", line)

    def out(self, name: str = "") -> str:
        """A path that leads out of the project, as a recorded state writes it."""
        return Path(os.path.relpath(self.outside / name, self.project)).as_posix()

    def link(self, place: str, target: str) -> None:
        """Replace a file or folder by a link to a copy outside."""
        path = self.project / place
        if path.is_dir():
            shutil.copytree(path, self.outside / target, dirs_exist_ok=True)
            shutil.rmtree(path)
        path.unlink(missing_ok=True)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.symlink_to(self.outside / target)

    def fifo(self, place: str) -> None:
        (self.project / place).parent.mkdir(parents=True, exist_ok=True)
        (self.project / place).unlink(missing_ok=True)
        os.mkfifo(self.project / place)

    def large(self, place: str) -> None:
        """A file without content that is too large to be read."""
        with (self.project / place).open("wb") as file:
            file.truncate(200_000_000)  # git reads it, too

    def template(self, text: str, name: str = "joint/axis.mo.jinja") -> str:
        self.write(f"templates/{name}", text)
        if "templates =" not in (self.project / "urdfsync.toml").read_text():
            self.configure('templates = "templates"')
        return f"templates/{name}"

    def modules(self) -> None:
        """A module of each name that Python and urdfsync import, as source and as compiled code."""
        for name in _MODULES:
            self.write(f"{name}.py", f"open({str(self.outside / 'module')!r}, 'w').close()\n")
        self.write(f"__pycache__/selectors.{sys.implementation.cache_tag}.pyc", b"code")
        self.write("evil-1.0.dist-info/entry_points.txt", "[urdfsync.domains]\nevil = selectors:DOMAIN\n")
        self.write("evil.pth", f"import os; os.mkdir({str(self.outside / 'pth')!r})\n")

    def leftover(self, path: str) -> None:
        """A temporary file of a build that was killed just before, or just after, it changed a file."""
        old = _digest((self.project / path).read_bytes())[:12] if (self.project / path).exists() else "none"
        folder, name, new = str(Path(path).parent), Path(path).name, _digest(b"evil")[:12]
        self.write(f"{folder}/.{name}.{old}-{new}.abcdef.urdfsync-tmp", b"evil")
        self.write(f"{folder}/.{name}.{new}-{old}.abcdef.urdfsync-tmp", b"evil")
        self.write(f"{folder}/.{name}.{new}-none.abcdef.urdfsync-tmp~", b"more evil")

    def manifest_file(self, path: str) -> None:
        """Record a file with its hash as a generated file, although no build generates it."""
        digest, name = _digest((self.project / path).read_bytes()), os.path.relpath(path, "modelica/Arm")
        self.edit(MANIFEST, '"files":{', f'"files":{{{json.dumps(name)}:"{digest}",')

    def manifest_folder(self, folder: str) -> None:
        """A record whose package had another folder before."""
        self.edit(MANIFEST, '"folder":"modelica/Arm"', f'"folder":{json.dumps(folder)}')

    def show(self, *names: str) -> None:
        """Give the robot meshes."""
        shapes = "".join(f'<visual><geometry><mesh filename="{name}"/></geometry></visual>' for name in names)
        self.edit("arm.urdf", '<link name="base"/>', f'<link name="base">{shapes}</link>')

    def meshes(self, *names: str) -> None:
        """Meshes whose readers would not end, or would take all memory."""
        for name in names:
            write_hostile(self.project, name)
        self.show(*names)

    def special_meshes(self) -> None:
        self.fifo("pipe.obj")
        self.large("sparse.stl")
        self.show("pipe.obj", "sparse.stl")

    def base_that_is_no_text(self) -> None:
        """A base that is no text, with the name of a recorded hash."""
        text, name = b"\xff\xfe", Path(RECORD).relative_to("modelica/Arm")
        manifest = (self.project / MANIFEST).read_text()
        self.write(MANIFEST, re.sub(rf"file \w+  {name}", f"file {_digest(text)}  {name}", manifest))
        line = f'{_digest(text)} "'.encode() + text + b'"\n'
        self.write(f".urdfsync/bases/arm/{_digest(text)[0]}", line)

    def entities(self) -> None:
        declared = "".join(f'<!ENTITY e{n + 1} "{f"&e{n};" * 10}">' for n in range(12))
        head = f'<!DOCTYPE robot [<!ENTITY e0 "ha"><!ENTITY x SYSTEM "file://{self.outside}/victim.mo">{declared}]>'
        text = (self.project / "arm.urdf").read_text().replace('name="base"', 'name="&e12;&x;"')
        self.write("arm.urdf", head + text.partition("?>")[2])

    def xacro(self, expression: str) -> None:
        """A source of xacro with an expression."""
        head = '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">'
        self.write("arm.urdf", f'{head}<link name="${{{expression}}}"/></robot>')

    def patterns(self) -> None:
        """A recorded expansion with endless patterns: each link doubles the number of matching files."""
        self.xacro("'base'")
        for name in ("more", "and_more"):
            (self.project / name).symlink_to(".")
        patterns = {"*/" * 30 + "*": "1", "**/*.xacro": "1", "/*/*/*/*/*/*": "1"}
        found = Expansion(source="arm.urdf", files={"arm.urdf": "1"}, patterns=patterns, text=urdf())
        self.write(".urdfsync/robots/arm.expanded", dumps(found))

    def deep_chain(self) -> None:
        """A robot that is a chain of joints, deeper than Python calls."""
        names = [f"l{number}" for number in range(1050)]
        joints = [joint(f"j{n}", "fixed", *names[n : n + 2]) for n in range(len(names) - 1)]
        self.write("arm.urdf", robot(*map(link, names), *joints))

    def terminal_files(self) -> None:
        """Files and robots whose names a terminal would obey."""
        self.write("\x1b]0;evil\x07.urdf", urdf())
        self.write("\x1b[2J.xml", "no robot")
        shutil.copy(self.project / MANIFEST, self.project / ".urdfsync/robots/\x1b[31m.state")
        self.edit("urdfsync.toml", '"arm.urdf"', '"\\u001b]0;evil\\u0007.urdf"')

    def bare_repository(self) -> None:
        """A repository among the files, whose settings name a program that git calls."""
        for place in ("refs/heads/keep", "objects/keep"):
            self.write(place, "")
        self.write("HEAD", "ref: refs/heads/main\n")
        settings = f'worktree = "."\nfsmonitor = "touch {self.outside}/git; false"\n'
        self.write("config", f"[core]\nrepositoryformatversion = 0\nbare = false\n{settings}")

    def git_files(self) -> None:
        """Attributes and modules that name programs; git runs only programs that its own settings define."""
        self.write(".gitattributes", "* filter=evil diff=evil merge=evil\n")
        url = f"ext::sh -c 'touch {self.outside}/git'"
        self.write(".gitmodules", f'[submodule "x"]\npath = x\nurl = "{url}"\n')


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


_SHELL = "cycler.__init__.__globals__.os.popen('touch {outside}/template').read()"
_TRUNCATE = (
    "(lambda: [c for c in ().__class__.__base__.__subclasses__() if c.__name__ == '_wrap_close'][0]"
    ".__init__.__globals__['sys'].modules['os'].open('{outside}/victim.mo', 512))()"
)
"""An expression with a function that empties a file."""
_STRANGE = urdf().replace('"tip"', '"\x9b31m\u202etip"').replace('"turn"', '"&#x9b;2J\u2028turn"')
"""Names that a terminal would obey: as an 8-bit control sequence, and as text that runs backwards."""

Attack = Callable[[Stranger], object]

COMMITTED: Mapping[str, Attack] = {
    "modules": Stranger.modules,
    "a domain of the repository": lambda one: (one.modules(), one.configure('domain = "evil"')),  # type: ignore[func-returns-value]
    "a template that leaves the sandbox": lambda one: one.template(f"<< {_SHELL.format(outside=one.outside)} >>\n"),
    "a template without end": lambda one: one.template(
        "<% macro m() %><< m() >><% endmacro %><< m() >>", "link/model.mo.jinja"
    ),
    "a template that is a link": lambda one: one.link(one.template("", "robot/model.mo.jinja"), "victim.mo"),
    "leftovers of the user's file": lambda one: one.leftover(MINE),
    "leftovers of a record": lambda one: one.leftover(MANIFEST),
    "a manifest with a file outside": lambda one: one.manifest_file(one.out("victim.mo")),
    "a manifest with the user's file": lambda one: one.manifest_file(MINE),
    "a manifest with the configuration": lambda one: one.manifest_file("urdfsync.toml"),
    "a manifest of a package outside": lambda one: one.manifest_folder(one.out()),
    "a manifest of the user's package": lambda one: one.manifest_folder("modelica/Other"),
    "state that is a link": lambda one: one.link(".urdfsync", "state"),
    "manifests that are a link": lambda one: one.link(".urdfsync/robots", "state"),
    "a manifest that is a link": lambda one: one.link(MANIFEST, "victim.mo"),
    "a leftover that is a link": lambda one: one.link(
        f".urdfsync/.lock.{'0' * 12}-{'0' * 12}.abcdef.urdfsync-tmp", "victim.mo"
    ),
    "bases that are a link": lambda one: one.link(".urdfsync/bases/arm", "folder"),
    "a record that is a link": lambda one: one.link(".urdfsync/deps/arm.robot", "victim.mo"),
    "a lock that is a link": lambda one: one.link(".urdfsync/lock", "victim.mo"),
    "conflicts that are a link": lambda one: one.link(".urdfsync/conflicts", "folder"),
    "a drawing that is a link": lambda one: one.link(".urdfsync/svg", "folder"),
    "a package that is a link": lambda one: one.link("modelica/Arm", "folder"),
    "an output folder that is a link": lambda one: one.link("modelica", "folder"),
    "an output that is a link": lambda one: one.link(RECORD, "victim.mo"),
    "an output folder outside": lambda one: one.configure(f"output = {json.dumps(one.out())}"),
    "a base that is no text": Stranger.base_that_is_no_text,
    "a deep manifest": lambda one: one.append(MANIFEST, 'option ["a",' + "[" * 200_000),
    "entities": Stranger.entities,
    "a source of xacro that empties a file": lambda one: one.xacro(_TRUNCATE.format(outside=one.outside)),
    "a source of xacro with recorded patterns": Stranger.patterns,
    "a deep source": lambda one: one.write(
        "arm.urdf", "<robot>" + "<link>" * 100_000 + "</link>" * 100_000 + "</robot>"
    ),
    "a long chain": Stranger.deep_chain,
    "huge numbers": lambda one: one.edit("arm.urdf", 'mass value="1.5"', f'mass value="{"9" * 100_000}"'),
    "names for the terminal": lambda one: one.write("arm.urdf", _STRANGE),
    "files for the terminal": Stranger.terminal_files,
    "a manifest for the terminal": lambda one: one.append(MANIFEST, 'option ["\\u001b[31mtip","\\u009b2J"]'),
    "a repository in the repository": Stranger.bare_repository,
    "attributes of git": Stranger.git_files,
    "meshes without end": lambda one: one.meshes(
        "expression.off", "list.ply", "accessor.gltf", "corners.obj", "deep.dae"
    ),
}
"""The attacks that a clone can contain."""
LOCAL: Mapping[str, Attack] = {
    "a template that is a FIFO": lambda one: one.fifo(one.template("")),
    "a source that is a FIFO": lambda one: one.fifo("arm.urdf"),
    "a configuration that is a FIFO": lambda one: one.fifo("urdfsync.toml"),
    "a manifest that is a FIFO": lambda one: one.fifo(MANIFEST),
    "a record that is a FIFO": lambda one: one.fifo(".urdfsync/deps/arm.robot"),
    "a lock that is a FIFO": lambda one: one.fifo(".urdfsync/lock"),
    "an output that is a FIFO": lambda one: one.fifo(RECORD),
    "a source of 200 MB": lambda one: one.large("arm.urdf"),
    "a configuration of 200 MB": lambda one: one.large("urdfsync.toml"),
    "meshes that are a FIFO and 200 MB": Stranger.special_meshes,
}
ATTACKS = {**COMMITTED, **LOCAL}

TOGETHER = (
    *("modules", "a template that leaves the sandbox", "a template without end", "a template that is a link"),
    *("a manifest with a file outside", "a manifest with the user's file", "a manifest with the configuration"),
    "a manifest of a package outside",
    *("bases that are a link", "a record that is a link", "a lock that is a link", "conflicts that are a link"),
    *("a drawing that is a link", "an output that is a link", "an output folder outside", "a base that is no text"),
    *("huge numbers", "names for the terminal", "a manifest for the terminal", "attributes of git"),
)
"""The attacks that one project can contain at once, without hiding most others."""


def attack(name: str, project: Path, outside: Path) -> None:
    """Apply an attack to a project."""
    ATTACKS[name](Stranger(project, outside))
