"""What a domain (URDF, or another data format) implements, and the neutral values it trades in.

The core reads bytes and asks the domain for a *snapshot* of the model, which is plain data. It imports the files that
the model depends on. It asks for the *artifacts* that follow from snapshot, imports and options, and renders, plans and
writes them. Nothing in here knows a domain, and nothing in here does IO.
"""

from __future__ import annotations

import enum
import math
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, Protocol, TypeAlias

import msgspec

from urdfsync.diagnostics import Diagnostic
from urdfsync.scene import Scene, Triangles

Snapshot: TypeAlias = Mapping[str, Any]
"""A model as plain data: mappings with string keys, lists, strings, numbers, booleans, None.

It equals its copy that comes back from JSON with sorted keys: the recorded model gives the same artifacts. It is keyed
by element name, and does not depend on the order of elements in the source. It holds all data of artifacts. Nobody
changes it: versions of a model may share parts.
"""

ElementKey: TypeAlias = tuple[str, str]
"""Kind and name of an element in the domain's words, for example `("link", "base_link")`."""


class Features(msgspec.Struct, frozen=True):
    """What an element is, and which elements are next to it: by these it is found again under another name."""

    contents: Mapping[str, Any]
    """Plain data by the words for it, such as `mass`; without names, and without what the element does not have."""
    neighbours: Mapping[str, ElementKey]
    """Elements by the relation to them, such as `parent`."""
    files: tuple[str, ...] = ()
    """The files that it refers to; they are no part of `contents`, since exporters name them after elements."""


class Role(enum.StrEnum):
    """Role of a generated file in the decision about it."""

    RECORD = "record"
    """Numbers and strings only: may be renewed while models wait for a conflict to be resolved."""
    MODEL = "model"
    PACKAGE = "package"
    ORDER = "order"
    """A `package.order` file; a domain describes it as an `Order`."""
    IMPORT = "import"
    """An imported file: bytes, not text; a domain describes it as a `Dependency`."""


class Artifact(msgspec.Struct, frozen=True):
    """One text file of the package: `path` (POSIX, below the package folder) is `template` rendered with `data`."""

    path: str
    role: Role
    template: str
    data: Mapping[str, Any]
    """Variables of the template: plain data and structs, which JSON can hold."""
    owner: str
    """The element that it belongs to, in the domain's words: `link base_link`, `joint elbow`, `robot`."""


class Templates(NamedTuple):
    """Folders that templates are taken from, best first, and the hash of all that is in them.

    The last folder is the domain's own; one before it is the user's.
    """

    folders: tuple[Path, ...]
    digest: str


class Order(msgspec.Struct, frozen=True):
    """One `package.order` file: urdfsync owns the lines in `names`, the user all others."""

    path: str
    names: tuple[str, ...]


class Dependency(msgspec.Struct, frozen=True):
    """A file that a source refers to and that is imported into the package."""

    key: str
    """Identity within the model: its URI in the source, and its conversion."""
    uri: str
    candidates: tuple[Path, ...]
    """Paths at which it may be, best first."""
    target: str
    """POSIX path of the imported file below the package folder; no other dependency has it."""
    noun: str
    """Its kind in one lower-case word, for messages and the codes of diagnostics."""
    line: int = 0
    """Line of the source that first refers to it; 0 if unknown."""
    guessed: bool = False
    """Whether it is found only in a folder that does not have the name of its package."""
    facts: tuple[str, ...] = ()
    """Names of the facts that artifacts need of it, where not all conversions have the same."""


class Conversion(msgspec.Struct, frozen=True):
    """A dependency's content as the package needs it, and `facts` (plain data) that artifacts need of it."""

    content: bytes
    facts: Mapping[str, Any]
    more: tuple[Conversion, ...] = ()
    """Further files that the dependency becomes; they are imports of their own, see `further_key`."""


def further_key(key: str, number: int) -> str:
    """Return the key of a further file that a dependency becomes; numbers begin with 1."""
    return f"{key} file {number}"


class Import(msgspec.Struct, frozen=True, omit_defaults=True):
    """A dependency that is in the package, now or from an earlier build on a machine that had its source."""

    target: str
    source_hash: str
    """SHA-256 (hex) of the dependency's bytes, and of those of `others`."""
    target_hash: str
    """SHA-256 (hex) of the imported bytes."""
    facts: Mapping[str, Any]
    others: tuple[str, ...] = ()
    """Other files that it is made of, found or not: paths from the folder of the dependency's own file."""


class ChangeKind(enum.StrEnum):
    """Kind of the difference of two versions at a value or an element."""

    ADDED = "added"
    REMOVED = "removed"
    CHANGED = "changed"
    RENAMED = "renamed"


class ChangeClass(enum.StrEnum):
    """Reach of a change, least first."""

    NONE = "none"
    """Nothing differs."""
    UNMODELLED = "unmodelled"
    """No file of the package depends on it."""
    PARAMETER = "parameter"
    """Records and imported files depend on it."""
    STRUCTURAL = "structural"
    """Models, packages or their order depend on it."""
    GENERATOR = "generator"
    """Template, option or release differ, which turn the model into files."""

    @property
    def rank(self) -> int:
        """Place in this order, from 0."""
        return list(ChangeClass).index(self)


class Version(msgspec.Struct, frozen=True):
    """A model as a build sees it."""

    snapshot: Snapshot
    imports: Mapping[str, Import] | None = None
    """The files that the model refers to, if found; None if nobody looked, and then each counts as found."""
    options: Any = None
    """The domain's options that it was built with; None if they are not known, or those of the other version."""


class Difference(msgspec.Struct, frozen=True):
    """One place at which two versions differ; `old` is None for what was added, `new` for what was removed."""

    path: tuple[str | int, ...]
    """Keys and indices (from 0) from the snapshot to the value; `("imports", key)` for an imported file."""
    kind: ChangeKind
    old: Any
    new: Any


class Meaning(msgspec.Struct, frozen=True):
    """A difference in the domain's words."""

    path: tuple[str, ...]
    """For example `("joint elbow", "origin", "xyz[2]")`; begins with the element."""
    change_class: ChangeClass
    unit: str = ""
    """Unit of both values, or `old → new` if they differ; empty for what has none."""


class Effect(msgspec.Struct, frozen=True):
    """A property of the whole model in both versions; None where it does not exist."""

    path: tuple[str, ...]
    old: Any
    new: Any
    unit: str = ""
    hint: str = ""
    """Order to the user; empty if there is nothing to do."""


class Reading(msgspec.Struct, frozen=True):
    """A source as it was read: the snapshot, unless a diagnostic is an error, and the diagnostics."""

    snapshot: Snapshot | None
    diagnostics: tuple[Diagnostic, ...]
    lines: Mapping[str, int] = msgspec.field(default_factory=dict)
    """Line of each element, keyed as the domain likes; passed back to `Domain.dependencies`."""
    option_findings: tuple[tuple[str, Diagnostic], ...] = ()
    """Findings about options for this model: the option, and a diagnostic without place.

    An error stops the build of the robot. The core adds the line of the configuration.
    """


class Lookup(msgspec.Struct, frozen=True):
    """Places of the files that a source refers to."""

    source: Path
    """The source file, absolute."""
    package_paths: tuple[Path, ...] = ()
    """Folders whose children are packages, from the configuration and the environment, best first."""
    packages: Mapping[str, Path] = msgspec.field(default_factory=dict)
    """Folders of packages by their name, wherever they are; filled only if something was not found without."""
    libraries: Mapping[str, Path] = msgspec.field(default_factory=dict)
    """Folders of the Modelica libraries on MODELICAPATH by their name; filled only if the source refers to one."""
    guess: bool = False
    """Whether a package that is nowhere may be a folder of another name around the source."""


class Target(msgspec.Struct, frozen=True):
    """Place of the generated package in Modelica's namespace."""

    package: str
    """Full name, for example `Plant.Robots.Arm`."""
    name: str
    """Class name of the main model, for example `Arm`."""


class Proposal(msgspec.Struct, frozen=True):
    """Value that `init` writes for one option, with the reason."""

    option: str
    value: Any
    reason: str


class Part(enum.StrEnum):
    """Part of a model that a verdict speaks of."""

    BODIES = "rigid bodies"
    LOSSES = "friction and gears"
    FREE_MOTION = "free motion"
    """Accelerations that follow from efforts."""
    LOOPS = "loops"
    """Gaps, and the forces that close them."""
    BENCHES = "Run and Test"
    SENSORS = "sensors"
    LIMITS = "limits"
    CONTACTS = "contacts"


class Quantity(enum.StrEnum):
    """Quantity of a frame, an axis, the root or the whole model that is compared with a reference; in SI units."""

    POSITION = "position"
    ORIENTATION = "orientation"
    """Elements of the rotation matrix."""
    EFFORT = "effort"
    REACTION = "reaction"
    """Force and torque that hold the root."""
    MASS = "mass"
    CENTRE = "centre of mass"
    ACCELERATION = "acceleration"
    READING = "reading"
    """Of a sensor."""
    GEAR = "gear"
    """Reduction, offset and inertia of the rotor."""
    WARNING = "warning"
    """Whether a limit is passed: 1 if so, else 0."""
    CONNECTION = "connection"
    """Whether a bench is connected as it should be: 0 if so, else 1."""
    GROUND = "ground force"
    CLOSURE = "gap"
    """From one frame of a loop to the other."""


TOLERANCE = 1e-10
"""The greatest difference that counts as agreement, relative to the greatest value of its kind or 1."""
_TOLERANCES = {
    Quantity.ACCELERATION: 1e-7,  # equations are solved for them, where digits are lost
    Quantity.GROUND: 1e-2,  # without a reference, and stiff: 1 % of the depth makes 1 % of the force
}


class Deviation(msgspec.Struct, frozen=True):
    """Greatest deviation of one quantity of one element from the reference, over all instants."""

    KEYS = ("quantity", "element", "difference", "value", "size", "unit", "part", "detail", "relative", "agrees")

    quantity: Quantity
    element: str
    """The element in the domain's words: `link hand`, `joint elbow`, `robot`."""
    difference: float
    """The greatest absolute difference, in `unit`; infinite or NaN if the simulation gave no number."""
    value: float
    """The greatest absolute value of the reference for this element, in `unit`."""
    size: float
    """The greatest absolute value of the reference for this quantity in this unit over all elements."""
    unit: str
    part: Part = Part.BODIES
    detail: str = ""
    """Which one of several: `below its lower position limit`."""
    least_tolerance: float = 0.0
    """See `Compared.least_tolerance`."""

    @property
    def key(self) -> tuple[str, ...]:
        """All that says which quantity of which element this is."""
        return self.part, self.quantity, self.element, self.unit, self.detail

    @property
    def relative(self) -> float:
        """Difference in relation to the greatest value of its kind, or to 1; infinite if that is no number."""
        relative = self.difference / max(1.0, self.size)
        return math.inf if math.isnan(relative) else relative

    @property
    def tolerance(self) -> float:
        """The greatest relative difference that counts as agreement."""
        return max(_TOLERANCES.get(self.quantity, TOLERANCE), self.least_tolerance)

    @property
    def agrees(self) -> bool:
        """Whether the difference is within the tolerance."""
        return self.relative <= self.tolerance


class Probe(msgspec.Struct, frozen=True):
    """A model that puts a package to the test: Modelica text, what to simulate, and which values to hand back."""

    source: str
    """One package; it names the libraries that it needs in imports."""
    model: str
    """Full name of the model in it."""
    stop: float
    """End of the simulation that begins at 0, in s."""
    step: float
    """Interval of results, in s."""
    values: tuple[str, ...]
    optional: tuple[str, ...] = ()
    """Variables that are handed back as well, if the package has them."""
    tolerance: float | None = None
    """Of the integration; None for the compiler's own."""


class Compared(msgspec.Struct, frozen=True):
    """One quantity of one element that is compared: which values of the probe it is made of, and when."""

    quantity: Quantity
    element: str
    unit: str
    values: tuple[str, ...]
    instants: tuple[float, ...]
    """Times, in s."""
    part: Part = Part.BODIES
    detail: str = ""
    """See `Deviation.detail`."""
    least_tolerance: float = 0.0
    """The least relative difference that counts as agreement, where a compiler loses more digits than usual."""


class Trial(msgspec.Struct, frozen=True):
    """One simulation of an experiment."""

    name: str
    """In words, for messages: `free motion`."""
    probe: Probe
    compared: tuple[Compared, ...]
    """From the root outwards."""
    expected: Mapping[str, tuple[float, ...]]
    """Expected numbers of each value at the times in `time`; NaN is possible."""
    over_time: tuple[Compared, ...] = ()
    """What is drawn at all times, and no part of the verdict."""
    expected_over_time: Mapping[str, tuple[float, ...]] = {}
    """The same as `expected` for it."""


class Experiment(msgspec.Struct, frozen=True):
    """A comparison of a generated package with an independent reference that reads the same source."""

    reference: str
    """Name and version."""
    content: bytes
    """The source to generate the package from: the one given, or a copy that has what a comparison needs."""
    options: Any
    """The options to generate it with, likewise."""
    trials: tuple[Trial, ...]
    """They move a package that follows from `content`, and as well one that follows from the source.

    The first one tells what single edits do; it has to come to its end.
    """
    notes: tuple[str, ...] = ()
    """Differences of `content` from the given source, with reasons: one sentence each, without a full stop."""
    unchecked: tuple[str, ...] = ()
    """Parts that are not compared, with reasons, likewise."""


class Signal(msgspec.Struct, frozen=True):
    """A quantity of a joint in a simulation; names are those of variables and parameters below the main model."""

    variable: str
    unit: str
    limits: tuple[str, ...] = ()
    """Parameters: the lower and the upper limit, one alone for a limit of the absolute value, none for no limit."""
    added: tuple[str, str] | None = None
    """A parameter and a variable whose product is a part of the quantity."""


class Axis(msgspec.Struct, frozen=True):
    """Quantities of one moving joint in a simulation."""

    element: str
    """In the domain's words: `joint elbow`."""
    position: Signal
    velocity: Signal
    effort: Signal | None = None
    """None for a joint without a drive of its own."""
    acceleration: Signal | None = None
    """With the limits while the joint slows down and while it speeds up; None for a joint that has no such limit."""
    is_dependent: bool = False
    """Whether the joint follows others through loops."""


class LoopSignals(msgspec.Struct, frozen=True):
    """Variables of a joint that closes a loop in a simulation, below the main model."""

    element: str
    """In the domain's words: `loop rocker_pin`."""
    gap: str
    """Distance of the two frames, in m."""
    force: tuple[str, ...]
    torque: tuple[str, ...]


class Sample(msgspec.Struct, frozen=True):
    """A source, and what its package is generated with."""

    content: bytes
    file: str
    """The source's name in diagnostics."""
    target: Target
    options: Any
    imports: Mapping[str, Import]


class Bench(msgspec.Struct, frozen=True):
    """Models and variables of a simulation; models are named below the package."""

    test: str
    """The model that needs no input."""
    run: str
    """The model that is driven by inputs; empty if there is none."""
    layouts: tuple[tuple[Axis, ...], ...]
    """For each approach, the axes by the names that they have there."""
    freedoms: int = 0
    """Degrees of freedom of the main model."""
    loops: tuple[LoopSignals, ...] = ()


class Domain(Protocol):
    """A data format and the Modelica package that follows from it; registered as entry point `urdfsync.domains`.

    A domain that inherits from this class defines `name`, `options`, `read`, `names` and `artifacts`. It overrides the
    defaults that do not suit it. docs/domains.md has an example.
    """

    name: str
    """Name in the configuration; also the folder below `templates/`, unless `templates` names another."""
    templates: Path | None = None
    """Folder with the domain's templates; None for the folder of its name in urdfsync's own."""
    warnings: Collection[str] = ()
    """Codes of the domain's warnings and notes, which a configuration may ignore."""
    options: type[Any]
    """A frozen msgspec.Struct with the domain's options and their defaults; the core refuses unknown keys."""

    def read(self, content: bytes, file: str, options: Any) -> Reading:
        """Read a source; `file` is its name in diagnostics. Pure, and raises nothing for bad input: see `Reading`."""
        ...

    def cross_check(self, content: bytes, file: str) -> Sequence[Diagnostic]:
        """Return differences from the model that another reader finds in a source without errors. It may take long.

        `file` is the source's name in diagnostics.
        """
        return ()

    def names(self, snapshot: Snapshot, target: Target) -> Mapping[str, Mapping[str, str]]:
        """Return, per kind of element in the plural, name in the source → identifier in Modelica."""
        ...

    def artifacts(
        self, snapshot: Snapshot, imports: Mapping[str, Import], target: Target, options: Any
    ) -> Iterable[Artifact | Order]:
        """Return every file of the package but the imported ones. Pure."""
        ...

    def uses(self, options: Any) -> Sequence[tuple[str, str]]:
        """Return the libraries that a generated package needs, with their versions, for a top-level `uses`."""
        return ()

    # Files that a source refers to

    def beside(self, source: Path) -> Path | None:
        """Return the file that may stand beside a source and say more of the model; None if this format has none."""
        return None

    def join(self, content: bytes, other: bytes, file: str) -> tuple[bytes, Sequence[tuple[int, int]]]:
        """Return a source with further lines for what the file beside it says, and the numbers of each, here and there.

        `file` is how diagnostics name it. Raises SourceError if it can't be read.
        """
        return content, ()

    def dependencies(
        self, snapshot: Snapshot, lookup: Lookup, options: Any, lines: Mapping[str, int]
    ) -> Sequence[Dependency]:
        """Return the files that the model refers to, each once. Pure: nothing is looked for yet."""
        return ()

    def mentioned(self, dependency: Dependency, file: str, content: bytes) -> Sequence[str]:
        """Return the files that the conversion needs besides: paths from the folder of the dependency's own file.

        Asked of the dependency's file, then of each file that is found so. Pure.
        """
        return ()

    def convert(self, dependency: Dependency, file: Path, content: bytes, others: Mapping[str, bytes]) -> Conversion:
        """Bring a dependency found at `file` into the package's form. Raises SourceError if it can't be read.

        `others` has the contents of the files that `mentioned` named; empty for what can't be read.
        """
        return Conversion(content, {})

    def import_findings(self, imports: Mapping[str, Import]) -> Iterable[tuple[str, Diagnostic]]:
        """Return diagnostics about imported files, without place, each with the key of its file; empty for all files.

        The core adds the line of the dependency.
        """
        return ()

    # Options

    def permissive_options(self) -> Any:
        """Return the options that sources outside of a project are read by: what they permit becomes a warning."""
        return self.options()

    def propose(self, snapshot: Snapshot, diagnostics: Sequence[Diagnostic]) -> Sequence[Proposal]:
        """Return option values that suit a model better than the defaults, for `init`.

        `diagnostics` are those of reading it by `permissive_options`.
        """
        return ()

    def option_for(self, name: str, snapshot: Snapshot, target: Target, options: Any) -> str:
        """Return the option that brings a class, connector, input or output, as the configuration has it.

        Empty if none does, or if `options` bring it.
        """
        return ""

    # Differences

    def features(self, snapshot: Snapshot) -> Mapping[ElementKey, Features]:
        """Return the elements that may get another name; by default their names alone tell which is which."""
        named = self.names(snapshot, Target("Package", "Model"))
        return {(kind.removesuffix("s"), name): Features({}, {}) for kind, names in named.items() for name in names}

    def comparable(self, snapshot: Snapshot, renames: Mapping[ElementKey, str]) -> Snapshot:
        """Return the snapshot with those elements renamed wherever it mentions them, in the order of a report.

        Lists without an order of their own may be keyed, so that the same things are compared. Elements that are
        `displaced` are left out.
        """
        return snapshot

    def describe(
        self, differences: Sequence[Difference], old: Version, new: Version, options: Any
    ) -> Sequence[Meaning | None]:
        """Return the meaning of each difference of two comparable versions; None if another difference says the same.

        By default another value is a parameter, and all that comes or goes is structural; `("parts", "motor", "mass")`
        reads `part motor / mass`.
        """
        meanings = []
        for difference in differences:
            kind, *path = map(str, difference.path)
            words = (f"{kind.removesuffix('s')} {path[0]}", *path[1:]) if path else (kind,)
            is_value = difference.kind is ChangeKind.CHANGED
            meanings.append(Meaning(words, ChangeClass.PARAMETER if is_value else ChangeClass.STRUCTURAL))
        return meanings

    def effects(self, old: Version, new: Version) -> Sequence[Effect]:
        """Return the effects of the differences on the whole model; the versions are as read, not comparable ones."""
        return ()

    def interface(
        self, old: Version, new: Version, renames: Mapping[ElementKey, str], target: Target, options: Any
    ) -> Sequence[Effect]:
        """Return changed names that users may have connected to; old is None for a new name, new for a removed one.

        `options` are those of the new version, and of the old one unless it has its own.
        """
        return ()

    def find_doubtful(
        self, old: Version, new: Version, renames: Mapping[ElementKey, str]
    ) -> Iterable[tuple[str, Diagnostic]]:
        """Return warnings about differences that look like a mistake of the export: a path, and one without place.

        The core adds the line of the path in the source, as `Reading` has it.
        """
        return ()

    # Commands beside `build`

    def drawing(self, snapshot: Snapshot, imports: Mapping[str, Import], target: Target, options: Any) -> str | None:
        """Return the main model's diagram as SVG text, or None if the domain draws none. Pure."""
        return None

    def scene(self, snapshot: Snapshot, imports: Mapping[str, Import], target: Target, options: Any) -> Scene | None:
        """Return the model as a picture with axes to move, or None if the domain has none. Pure.

        An import without facts is a file that is too large for the package.
        """
        return None

    def triangles(self, path: str, content: bytes, key: str, most: int) -> Triangles | str:
        """Return at `most` so many triangles of a mesh, or about that; or why there are none.

        It is an imported file at `path`, or what the dependency `key` has, if that is too large to be imported.
        """
        return "it is no mesh"

    def models(self, snapshot: Snapshot, target: Target, options: Any) -> Sequence[str]:
        """Return the classes that have to compile by themselves, by name below the package, the main one first."""
        return (target.name,)

    def bench(self, snapshot: Snapshot, target: Target, options: Any) -> Bench | None:
        """Return the models and variables of a simulation, or None if nothing in the package can be simulated. Pure."""
        return None

    def record(
        self, reading: Reading, file: str, target: Target, options: Any
    ) -> tuple[Artifact, Sequence[Diagnostic]] | None:
        """Return the whole model as one record that stands alone, with its own findings; or None.

        `file` is the source's name in diagnostics. `target.name` is the record's class, `target.package` the package
        that it says it stands in, empty for none. Nothing is imported for it. Pure.
        """
        return None

    def experiment(self, sample: Sample, step: float | None = None) -> Experiment | str:
        """Return a comparison of the generated package with an independent reference, or why there is none.

        What the source lacks for a telling comparison (inertias, say) is made up. With a `step`, in s, there is
        something to draw: `Trial.over_time`. It runs in a process of its own. Raises SourceError if the reference can't
        be had or can't read it.
        """
        return "there is no reference for such packages"

    def wiring(
        self, texts: Mapping[str, bytes], snapshot: Snapshot, target: Target, options: Any
    ) -> Iterable[Deviation]:
        """Return whether the benches of a generated package are connected as they should be, by their texts."""
        return ()


def brings_back(option: str, new_name: str = "") -> str:
    """Return the hint to set the option that brings a name back, perhaps as a new name; empty without option."""
    return f"set `{option}` to bring it back{f' as `{new_name}`' if new_name else ''}" if option else ""


def displaced(renames: Mapping[ElementKey, str]) -> set[ElementKey]:
    """Return the removed elements whose names other elements have now."""
    return {(kind, name) for (kind, _), name in renames.items()} - renames.keys()
