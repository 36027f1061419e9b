within Zoo.Mill;

record MillParameters "Numbers of robot Mill as a whole"
  extends UrdfSync.Records.Robot(
    name = "mill",
    connectionMatrix = [1, 2; 1, 3; 3, 4; 1, 5; 5, 6; 1, 7; 7, 8; 1, 9],
    moveableJoints = [1, 1; 2, 1; 3, 1; 4, 1; 5, 1; 6, 1; 7, 1; 8, 1]);

  UrdfSync.Records.Link ground_32f49b(
    name = "ground",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 8,
      inertia(
        ixx = 0.1,
        iyy = 0.1,
        izz = 0.1,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 1: \"ground\"";

  UrdfSync.Records.Link die(
    name = "die",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1,
      inertia(
        ixx = 0.01,
        iyy = 0.01,
        izz = 0.01,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 2: \"die\"";

  UrdfSync.Records.Link arm(
    name = "arm",
    inertial(
      origin(
        xyz = {0.1, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.25,
      inertia(
        ixx = 0.0001,
        iyy = 0.001,
        izz = 0.001,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 3: \"arm\"";

  UrdfSync.Records.Link bar(
    name = "bar",
    inertial(
      origin(
        xyz = {0.25, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.5,
      inertia(
        ixx = 0.0001,
        iyy = 0.01,
        izz = 0.01,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 4: \"bar\"";

  UrdfSync.Records.Link bob(
    name = "bob",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.5,
      inertia(
        ixx = 0.001,
        iyy = 0.001,
        izz = 0.001,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 5: \"bob\"";

  UrdfSync.Records.Link ring(
    name = "ring",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.25,
      inertia(
        ixx = 0.001,
        iyy = 0.001,
        izz = 0.001,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 6: \"ring\"";

  UrdfSync.Records.Link shoe(
    name = "shoe",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1,
      inertia(
        ixx = 0.01,
        iyy = 0.01,
        izz = 0.01,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 7: \"shoe\"";

  UrdfSync.Records.Link rod(
    name = "rod",
    inertial(
      origin(
        xyz = {0.25, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.5,
      inertia(
        ixx = 0.0001,
        iyy = 0.01,
        izz = 0.01,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 8: \"rod\"";

  UrdfSync.Records.Link lever(
    name = "lever",
    inertial(
      origin(
        xyz = {0.1, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.25,
      inertia(
        ixx = 0.0001,
        iyy = 0.001,
        izz = 0.001,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 9: \"lever\"";

  UrdfSync.Records.PrismaticJoint block_181fd7(
    name = "block",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -1,
      upper = 1,
      velocity = 1,
      effort = 100))
    "Joint 1: \"block\"";

  UrdfSync.Records.ContinuousJoint crank(
    name = "crank",
    origin(
      xyz = {0, 0, 0.5},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf))
    "Joint 2: \"crank\"";

  UrdfSync.Records.ContinuousJoint arm_pin(
    name = "arm_pin",
    origin(
      xyz = {0.25, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf))
    "Joint 3: \"arm_pin\"";

  UrdfSync.Records.BallJoint hook(
    name = "hook",
    origin(
      xyz = {0, 0, -0.5},
      rpy = {0, 0, 0}),
    damping = 0.125)
    "Joint 4: \"hook\"";

  UrdfSync.Records.BallJoint eye(
    name = "eye",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}))
    "Joint 5: \"eye\"";

  UrdfSync.Records.PrismaticJoint ram(
    name = "ram",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -1,
      upper = 1,
      velocity = 1,
      effort = 100))
    "Joint 6: \"ram\"";

  UrdfSync.Records.ContinuousJoint shoe_pin(
    name = "shoe_pin",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf))
    "Joint 7: \"shoe_pin\"";

  UrdfSync.Records.RevoluteJoint rocker(
    name = "rocker",
    origin(
      xyz = {0.5, 0, 0.5},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -3,
      upper = 3,
      velocity = 5,
      effort = 10))
    "Joint 8: \"rocker\"";

  annotation (Documentation(info="<html>
<p>
All numbers of robot Mill in one record, for studies that need them all. <code>UrdfSync.Robots.GenericRobot</code> can't take it, since a joint is planar, floating or a ball. Where the package has models of the links and joints, these read the records of their elements, and the numbers here are a copy: an edit here changes no such model.
</p>
</html>"));
end MillParameters;
