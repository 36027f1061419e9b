"""Patterns of the expected texts in the models of a package, as `path = text`; the comparison fills in words.

A path names a value, the type of a component, the base classes, or one end of a connection.
"""

from __future__ import annotations

from collections.abc import Mapping

WORDS = {
    True: dict(zip("qvf", ("phi", "w", "tau"), strict=True), Q='"rad"', V='"rad/s"', F='"N.m"', push="Torque"),
    False: dict(zip("qvf", ("s", "v", "f"), strict=True), Q='"m"', V='"m/s"', F='"N"', push="Force"),
}
"""For turning (True) and sliding joints: letters and units of position, speed and effort, and the effort's source."""
UNITS = {"a": '"m/s2"', "w": '"rad/s"', "f": '"N"', "t": '"N.m"'}
"""Units of the outputs of sensors."""
SURFACE = {"kp": "stiffness", "kd": "viscosity", "mu": "friction", "minDepth": "minDepth"}
"""Names of a contact's parameters, by the names of numbers in the link's record."""

ROBOT = "extends = UrdfSync.Robots.Partial{Base}Robot; m = {masses}; type of m = finalparameterModelica.Units.SI.Mass"
LINK = "type of {c} = replaceableLinks.{C}; {c}.animation = animation; {c}.showCollisions = showCollisions"
JOINT = "type of {c} = replaceableJoints.{C}"
AXIS = "{c}.fixedStart = {fixed}; {c}.checkLimits = checkLimits"
LEADER = (
    "{c}.{q}_min = max({{{least}}}); {c}.{q}_max = min({{{most}}}); "
    "{c}.{v}_max = min({{{c}.parameters.limits.velocity{speeds}}})"
)
FOLLOWER = (
    "{c}.{q}_start = {start}; {c}.fixedStart = false; {c}.stateSelect = StateSelect.avoid; {c}.checkEffort = false; "
    "{c}.checkLimits = checkLimits; {m}.parameters = {c}.parameters.mimic; type of {m} = UrdfSync.Couplings.{kind}"
)
COUPLING = "{m}.{q}_min = {c}.{q}_min; {m}.{q}_max = {c}.{q}_max; {m}.{v}_max = {c}.{v}_max"
GEAR = "{g}.parameters = {c}.parameters.transmission; type of {g} = UrdfSync.Drives.SharedGear"
SENSOR = "type of {c} = UrdfSync.Sensors.{kind}; {c}.parameters = sensorParameters.{c}"
SENSORS = {
    "imu": ("Imu", "aw"), "accelerometer": ("Imu", "a"), "gyroscope": ("Imu", "w"),
    "force_torque": ("ForceTorque", "ft"), "camera": ("Camera", ""), "lidar": ("Lidar", ""),
}  # fmt: skip
"""Class of a sensor and letters of its outputs, by kind."""
CONNECTORS = {
    "Frame": "MultiBody.Interfaces.Frame_b", "Axis": "{kind}.Interfaces.Flange_a",
    "Support": "{kind}.Interfaces.Flange_b", "Motor": "Rotational.Interfaces.Flange_a",
}  # fmt: skip
"""Types of the robot's connectors by the ending of the name."""
FRICTION = (
    "FrictionLaw = UrdfSync.Friction.{law}constrainedbyUrdfSync.Friction.Partial{kind}; "
    "type of FrictionLaw = replaceablemodel; type of friction = FrictionLaw; friction.parameters = parameters.dynamics"
)
SPRING = (
    "elasticity.stateSelect = StateSelect.default; elasticity.{q}_rel.fixed = fixedStart; "
    "elasticity.{v}_rel.fixed = fixedStart; type of elasticity = "
)
SPRINGS = {
    False: SPRING + "Modelica.Mechanics.{kind}.Components.SpringDamper; "
    "elasticity.c = parameters.transmission.stiffness; elasticity.d = parameters.transmission.damping",
    True: SPRING + "UrdfSync.Drives.{kind}Spring; elasticity.parameters = parameters.transmission; "
    "elasticity.limits = parameters.limits",
}  # fmt: skip
"""The spring between drive and joint; True is a saturating spring."""
BENCH = {
    "fixed": "type of robot = replaceable{name}; robot.frame_a = world.frame_b; extends = UrdfSync.Robots.PartialBench",
    "floating": "type of robot = replaceable{name}; robot.frame_a = base.frame_b; stance = {name}Stance; "
    "load = robot.m*world.g; extends = UrdfSync.Robots.PartialMobileBench",
}
EXPERIMENT = "; experiment.StopTime = 10; experiment.Interval = 0.02; experiment.Tolerance = {tolerance}"
OUTPUT = "{o} = {value}; {o}.unit = {unit}; type of {o} = Modelica.Blocks.Interfaces.RealOutput"
_EFFORT = OUTPUT.format(o="{joint}_{f}", value="{axis}.{f}", unit="{F}")
_DRIVE = "{axis} = {d}.flange; {support} = {d}.support; type of {d} = "
_SOURCE = _DRIVE + "Modelica.Mechanics.{kind}.Sources."
_INPUT = "; {d}.useSupport = true; type of {inputs} = Modelica.Blocks.Interfaces.RealInput"
TEST = (
    _DRIVE + "UrdfSync.Drives.{kind}Sweep; {d}.{q}_start = {own}.{q}_start; {d}.{q}_min = {own}.{q}_min; "
    "{d}.{q}_max = {own}.{q}_max; {d}.{v}_max = {own}.{v}_max"
)
RUN = {
    "position": "{d}.{q}_ref = {command}; " + _SOURCE + "Position; {d}.exact = false; {d}.{v}.fixed = true; "
    "{input}.unit = {Q}; " + _EFFORT + _INPUT,
    "velocity": "{d}.{v}_ref = {command}; " + _SOURCE + "Speed; {d}.exact = false; {d}.{q}.start = {own}.{q}_start; "
    "{input}.unit = {V}; " + _EFFORT + _INPUT,
    "effort": "{d}.{f} = {command}; " + _SOURCE + "{push}; {input}.unit = {F}; "
    + OUTPUT.format(o="{joint}_{q}", value="{axis}.{q}-{support}.{q}", unit="{Q}") + "; "
    + OUTPUT.format(o="{joint}_{v}", value="der({joint}_{q})", unit="{V}") + _INPUT,
}  # fmt: skip
"""The source of a joint in Run, by its command."""

GENERIC = {
    "fixed": "extends = UrdfSync.Robots.PartialBench,Modelica.Icons.Example; type of robot = "
    "UrdfSync.Robots.GenericRobot; robot.data = {name}Parameters; robot.fixedStart = false; "
    "robot.frame_a = world.frame_b",
}
GENERIC["floating"] = (
    GENERIC["fixed"].replace("world.", "base.") + "; base.frame_a = world.frame_b; type of base = "
    "UrdfSync.Robots.FreeBase; base.r_start = {{0,0,robot.data.standingHeight}}"
)
GENERIC_AXES = (
    "type of {k}Drive = Modelica.Mechanics.{kind}.Sources.Position; {k}Drive.useSupport = true; {k}Drive.exact = true; "
    "{k}Drive.flange = robot.{k}Axis; {k}Drive.support = robot.{k}Support; {k}Drive.{q}_ref = {k}Sweep.y; "
    "type of {k}Sweep = UrdfSync.Robots.AxisSweeps; {k}Sweep.n = {n}; {k}Sweep.start = robot.{q}_start; "
    "{k}Sweep.lower = robot.{q}_min; {k}Sweep.upper = robot.{q}_max; {k}Sweep.velocity = robot.{v}_max; "
    "{k}Sweep.reach = {reach}"
)
SHAPE = (
    "type of {part} = UrdfSync.Visualizers.{kind}; {part}.frame_a = frame_a; {part}.parameters = parameters.{part}; "
    "{part}.animation = {shown}"
)
CONSTRAINT = (
    "type of constraint = UrdfSync.Loops.Constraint; constraint.translations = parameters.translations; "
    "constraint.rotations = parameters.rotations; constraint.childRotations = parameters.childRotations"
)
"""The constraint in the model of a loop."""
FREE = {
    "floating": "extends = UrdfSync.Icons.FloatingJoint,UrdfSync.Interfaces.PartialFloatingJoint; "
    "parameters = {C}Parameters; frame_a = origin.frame_a; origin.frame_b = freeMotion.frame_a; "
    "freeMotion.frame_b = frame_b; type of freeMotion = UrdfSync.Robots.FreeBase; freeMotion.fixedStart = fixedStart; "
    "freeMotion.r_start = r_start; freeMotion.rpy_start = rpy_start; freeMotion.v_start = v_start; "
    "freeMotion.w_start = w_start",
    "planar": "extends = UrdfSync.Icons.PlanarJoint,UrdfSync.Interfaces.PartialPlanarJoint; "
    "parameters = {C}Parameters; frame_a = origin.frame_a; origin.frame_b = prismatic_x.frame_a; "
    "prismatic_x.frame_b = prismatic_y.frame_a; prismatic_y.frame_b = revolute.frame_a; revolute.frame_b = frame_b; "
    'type of n_x = finalparameterReal; n_x.unit = "1"; n_x = UrdfSync.Functions.normalTo(parameters.axis)',
}
"""The models of joints that the comparison with Pinocchio does not move."""
PLACED = (
    "type of origin = Modelica.Mechanics.MultiBody.Parts.FixedRotation; origin.animation = false; "
    "origin.r = parameters.origin.xyz; origin.sequence = {{3,2,1}}; origin.angles = Modelica.Units.Conversions.to_deg("
    "{{parameters.origin.rpy[3],parameters.origin.rpy[2],parameters.origin.rpy[1]}}); origin.rotationType = "
    "Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence"
)
FREEDOM = (
    "type of {j} = Modelica.Mechanics.MultiBody.Joints.{Joint}; {j}.animation = false; {j}.useAxisFlange = {axis}; "
    "{j}.n = {n}; {j}.stateSelect = StateSelect.prefer; {j}.{q}.start = {q}_start{k}; {j}.{q}.fixed = fixedStart; "
    "{j}.{v}.start = {v}_start{k}; {j}.{v}.fixed = fixedStart"
)
LOSS = (
    "; type of {f} = UrdfSync.Friction.{kind}; {f}.parameters = parameters.{of}; "
    "{j}.support = {f}.flange_a; {j}.axis = {f}.flange_b"
)
FREEDOMS = {
    "prismatic_x": ("n_x", "[1]", "friction_x", "translation"),
    "prismatic_y": ("cross(parameters.axis,n_x)", "[2]", "friction_y", "translation"),
    "revolute": ("parameters.axis", "", "friction", "rotation"),
}
"""The freedoms of a planar joint: axis, index of the start, friction, and the numbers of the friction."""
NORMAL = (
    "type of normalTo = function; type of n = inputReal; type of u = outputReal; type of e = Real; type of p = Real; "
    'n.unit = "1"; u.unit = "1"; e = ifabs(n[1])<0.9*sqrt(n*n)then{{1,0,0}}else{{0,1,0}}; p = e-(e*n)/(n*n)*n'
)
"""The function of the first direction of a planar joint."""
VISUALIZER = (
    "extends = UrdfSync.Visualizers.PartialShape; type of parameters = parameterUrdfSync.Records.{kind}; "
    "type of R = finalparameterReal; R = UrdfSync.Functions.rotation(parameters.origin.rpy)"
)
DRAWING = (
    "type of {s} = Modelica.Mechanics.MultiBody.Visualizers.Advanced.Shape; {s}.shapeType = {form}; "
    "condition of {s} = world.enableAnimationandanimation; {s}.r = frame_a.r_0; {s}.R = frame_a.R; "
    "{s}.r_shape = parameters.origin.xyz{shift}; {s}.lengthDirection = R[:,{along}]; "
    "{s}.widthDirection = R[:,{across}]; {s}.length = {length}; {s}.width = {width}; {s}.height = {height}; "
    "{s}.color = parameters.color"
)
"""A shape of the Modelica Standard Library begins at `r_shape` and extends along `lengthDirection`."""
_BALL = {"form": '"sphere"', "along": 3, "across": 1} | dict.fromkeys(
    ("length", "width", "height"), "2*parameters.radius"
)
_ROUND = _BALL | {"form": '"cylinder"', "length": "parameters.length", "shift": "-0.5*parameters.length*R[:,3]"}
_END = "{sign}0.5*parameters.length*R[:,3]-parameters.radius*R[:,3]"
_SIZE = {name: f"parameters.size[{k}]" for k, name in enumerate(("length", "width", "height"), 1)}
_PLAIN = {"along": 1, "across": 2}
DRAWINGS: Mapping[str, Mapping[str, Mapping[str, object]]] = {
    "Box": {"shape": _PLAIN | _SIZE | {"form": '"box"', "shift": "-0.5*parameters.size[1]*R[:,1]"}},
    "Cylinder": {"shape": _ROUND},
    "Sphere": {"shape": _BALL | {"shift": "-parameters.radius*R[:,3]"}},
    "Capsule": {"shape": _ROUND}
    | {f"{end}End": _BALL | {"shift": _END.format(sign=sign)} for end, sign in (("lower", "-"), ("upper", "+"))},
    "Mesh": {"shape": _PLAIN | {"form": "parameters.uri", "shift": ""} | dict.fromkeys(_SIZE, "1")},
}
"""Shapes of URDF, with the shapes of the Modelica Standard Library that draw them."""
CONTACT = "type of {c} = UrdfSync.Contacts.{kind}; {c}.frame_a = frame_a; {c}.parameters = parameters.{part}"


def pairs(text: str, **words: object) -> dict[str, str]:
    """Return the texts of a pattern by paths."""
    parts = (pair.partition(" = ") for pair in text.format(**words).split("; "))
    return {path: value for path, _, value in parts}
