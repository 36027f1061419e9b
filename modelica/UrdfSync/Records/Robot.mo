within UrdfSync.Records;

record Robot "Numbers of a whole robot: what all robots have"
  extends UrdfSync.Icons.Parameters;

  String name = ""
    "Name of the robot in the URDF";

  Modelica.Units.SI.Position standingHeight = 0
    "Height of the root frame above the lowest point of all collision shapes, all joints at their start";

  Integer connectionMatrix[:, 2] = fill(0, 0, 2)
    "One row per joint: {number of the parent link, number of the child link}, counted from 1; link 1 is the root";

  Integer moveableJoints[:, 2] = fill(0, 0, 2)
    "One row per joint that is not fixed: {number of the joint, 1}";

  parameter Integer movingJoints(min = 0) = 0
    "Number of moving joints: those that turn or slide"
    annotation (Evaluate=true);

  parameter Integer turningJoints(min = 0) = 0
    "Number of moving joints that turn"
    annotation (Evaluate=true);

  parameter Integer slidingJoints(min = 0) = 0
    "Number of moving joints that slide"
    annotation (Evaluate=true);

  parameter Integer rotationalAxes(min = 0) = 0
    "Number of driven axes that turn"
    annotation (Evaluate=true);

  parameter Integer translationalAxes(min = 0) = 0
    "Number of driven axes that slide"
    annotation (Evaluate=true);

  parameter Integer drawnShapes(min = 0) = 0
    "Number of shapes that are drawn"
    annotation (Evaluate=true);

  parameter Integer jointTree[:, 2] = fill(0, 0, 2)
    "One row per moving joint: {number of the body that carries it, 1 if it turns or 2 if it slides}"
    annotation (Evaluate=true);

  parameter Integer firstJoints[:] = {1}
    "Per body: the first moving joint that it carries; number of moving joints + 1 if there is none"
    annotation (Evaluate=true);

  parameter Integer nextJoints[:] = fill(0, 0)
    "Per moving joint: the next one on the same body; number of moving joints + 1 if there is none"
    annotation (Evaluate=true);

  parameter Integer linkBodies[:] = {1}
    "Per link: number of the body that it is part of; 1 is the base, i + 1 is what moving joint i moves"
    annotation (Evaluate=true);

  parameter Integer turning[:] = fill(0, 0)
    "Moving joints that turn"
    annotation (Evaluate=true);

  parameter Integer sliding[:] = fill(0, 0)
    "Moving joints that slide"
    annotation (Evaluate=true);

  parameter Integer rotationalJoints[:] = fill(0, 0)
    "Per driven axis that turns: number of its moving joint"
    annotation (Evaluate=true);

  parameter Integer translationalJoints[:] = fill(0, 0)
    "Per driven axis that slides: number of its moving joint"
    annotation (Evaluate=true);

  parameter Integer followers[:, 2] = fill(0, 0, 2)
    "One row per moving joint that follows another one, leaders first: {its number, number of its leader, 0 if that does not move}"
    annotation (Evaluate=true);

  parameter Real jointAxes[:, 3](each unit = "1") = fill(0, 0, 3)
    "Per moving joint: axis in the joint frame, a unit vector"
    annotation (Evaluate=true);

  JointName jointNames[movingJoints]
    "Per moving joint: its name in the URDF";

  Modelica.Units.SI.Position jointPositions[:, 3] = fill(0, 0, 3)
    "Per joint, fixed ones included: origin in the frame of the parent link";

  Modelica.Units.SI.Angle jointAngles[:, 3] = fill(0, 0, 3)
    "Per joint, fixed ones included: roll, pitch and yaw in the frame of the parent link";

  TurningLimits turningLimits
    "Limits of the moving joints that turn";

  SlidingLimits slidingLimits
    "Limits of the moving joints that slide";

  JointDynamics.RotationalDynamics turningLosses[turningJoints]
    "Losses and mechanisms of the moving joints that turn";

  JointDynamics.TranslationalDynamics slidingLosses[slidingJoints]
    "Losses and mechanisms of the moving joints that slide";

  Modelica.Units.SI.Inertia turningInertias[turningJoints] = zeros(turningJoints)
    "What the drives of the joints that turn add to the inertia about their axes";

  Modelica.Units.SI.Mass slidingMasses[slidingJoints] = zeros(slidingJoints)
    "What the drives of the joints that slide add to the mass along their axes";

  Real followerMultipliers[:] = fill(0, 0)
    "Per row of followers: rad or m of the joint per rad or m of its leader";

  Modelica.Units.SI.Angle followerAngles[:] = fill(0, 0)
    "Per row of followers: position where the leader is at zero; zero for a joint that slides";

  Modelica.Units.SI.Position followerLengths[:] = fill(0, 0)
    "Per row of followers: position where the leader is at zero; zero for a joint that turns";

  Modelica.Units.SI.Mass linkMasses[:] = {0}
    "Per link: mass";

  Modelica.Units.SI.Position linkCenters[:, 3] = fill(0, 1, 3)
    "Per link: centre of mass in the link frame";

  Modelica.Units.SI.Angle inertialAngles[:, 3] = fill(0, 1, 3)
    "Per link: roll, pitch and yaw of the inertial frame in the link frame";

  Modelica.Units.SI.MomentOfInertia linkInertias[:, 6](each min = -Modelica.Constants.inf) = fill(0, 1, 6)
    "Per link: elements {xx, yy, zz, xy, xz, yz} about the centre of mass, in the inertial frame";

  Visuals visuals
    "Shapes that are drawn";

  // rumoca does not find the sizes of arrays that a function gives where they are modifiers of a record: so they are components here.
  final Real linkRotations[size(linkBodies, 1), 3, 3](each unit = "1") =
    UrdfSync.Dynamics.linkRotations(connectionMatrix, linkBodies, jointAngles)
    "Per link: rotation in its body";

  final Modelica.Units.SI.Position linkPositions[size(linkBodies, 1), 3] =
    UrdfSync.Dynamics.linkPositions(connectionMatrix, linkBodies, jointPositions, linkRotations)
    "Per link: origin in its body";

  final Real jointRotations[size(jointTree, 1), 3, 3](each unit = "1") =
    UrdfSync.Dynamics.jointRotations(connectionMatrix, linkBodies, jointTree, jointAngles, linkRotations)
    "Per moving joint: rotation at position zero in the body that carries it";

  final Modelica.Units.SI.Position jointOrigins[size(jointTree, 1), 3] =
    UrdfSync.Dynamics.jointOrigins(connectionMatrix, linkBodies, jointTree, jointPositions, linkRotations, linkPositions)
    "Per moving joint: origin at position zero in the body that carries it";

  final Real turnAxes[size(jointTree, 1), 3](each unit = "1") = UrdfSync.Dynamics.turnAxes(jointTree, jointAxes)
    "Per moving joint: unit vector along its axis; zero if it slides";

  final Modelica.Units.SI.Position slideAxes[size(jointTree, 1), 3] = UrdfSync.Dynamics.slideAxes(jointTree, jointAxes)
    "Per moving joint: vector of one metre along its axis; zero if it turns";

  final Modelica.Units.SI.Mass bodyMasses[size(jointTree, 1) + 1] =
    UrdfSync.Dynamics.bodyMasses(linkBodies, linkMasses, size(jointTree, 1))
    "Per body: mass";

  final Real bodyMoments[size(jointTree, 1) + 1, 3](each unit = "kg.m") =
    UrdfSync.Dynamics.bodyMoments(linkBodies, linkRotations, linkPositions, linkMasses, linkCenters, size(jointTree, 1))
    "Per body: mass times centre of mass";

  final Modelica.Units.SI.MomentOfInertia bodyInertias[size(jointTree, 1) + 1, 3, 3](each min = -Modelica.Constants.inf) =
    UrdfSync.Dynamics.bodyInertias(
      linkBodies,
      linkRotations,
      linkPositions,
      linkMasses,
      linkCenters,
      inertialAngles,
      linkInertias,
      size(jointTree, 1))
    "Per body: inertia tensor about its origin";

  final Modelica.Units.SI.MomentOfInertia driveInertias[size(jointTree, 1)] = UrdfSync.Dynamics.jointVector(
    size(jointTree, 1),
    turning,
    turningInertias,
    sliding,
    slidingMasses,
    UrdfSync.Dynamics.unitLength^2)
    "Per moving joint: what its drive adds to the inertia";

  final RigidBodyTree tree(
    jointTree = jointTree,
    linkBodies = linkBodies,
    linkRotations = linkRotations,
    linkPositions = linkPositions,
    jointRotations = jointRotations,
    jointOrigins = jointOrigins,
    turnAxes = turnAxes,
    slideAxes = slideAxes,
    bodyMasses = bodyMasses,
    bodyMoments = bodyMoments,
    bodyInertias = bodyInertias,
    driveInertias = driveInertias)
    "Bodies and joints, for the functions of Dynamics";

  annotation (Documentation(info="<html>
<p>
The record of a generated robot adds one component per link, per visual and per joint, and one constant <code>&lt;joint&gt;Axis</code> per driven axis: its
number. Links and joints are numbered depth-first from the root, siblings in natural order of their names: joint <code>k</code> leads to link
<code>k + 1</code>.
</p>
<p>
The tables after <code>moveableJoints</code> are what <a href=\"modelica://UrdfSync.Robots.GenericRobot\">Robots.GenericRobot</a> and
<a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a> read. Their numbers are references to the components of the links and joints, so that no
number stands in the record twice, and a modifier of a link or joint reaches them.
</p>
<p>
<i>Bodies:</i> links that fixed joints connect move as one body. Body 1 is that of the root link, and moving joint <code>i</code> moves body
<code>i + 1</code>. A <i>moving joint</i> is revolute, continuous or prismatic; moving joints are counted in the order of the joints, so that what
carries a joint has a smaller number than what it moves. The tables say which link belongs to which body; what stands after them, from
<code>linkRotations</code> on, follows from the tables by functions of <a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a>.
</p>
<p>
<i>Driven axes</i> are the moving joints that follow no other one, turning and sliding ones apart, each in the order of the joints. In a chain of
mimic joints each follower names the joint that it follows itself, and has the numbers of its own <code>&lt;mimic&gt;</code> element.
</p>
<p>
A robot with a planar, floating or ball joint has no such tables: they keep the values of a single link.
</p>
</html>"));
end Robot;
