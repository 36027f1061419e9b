within UrdfSync.Robots;

partial model PartialRecordRobot "Axes, mimic joints, losses and limits of a robot that is read from its record"
  extends UrdfSync.Icons.StationaryRobot;

  replaceable parameter UrdfSync.Records.Robot data
    "Numbers of the whole robot"
    annotation (choicesAllMatching=true);

  parameter Integer tool = UrdfSync.Dynamics.toolLink(data.jointTree, data.linkBodies)
    "Number of the link whose frame is frame_b; as it is, the one at the end of the longest chain of moving joints"
    annotation (Evaluate=true);

  parameter Boolean animation = true
    "= true, if visuals are drawn"
    annotation (Dialog(tab="Animation"));

  parameter Boolean checkLimits = true
    "= true, if a joint that passes one of its limits is reported by a warning"
    annotation (Dialog(group="Limits"));

  parameter Boolean fixedStart = true
    "= true, if the simulation begins at the start values below; = false, if they are guesses, for axes that are driven by position"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Angle phi_start[data.rotationalAxes] = UrdfSync.Dynamics.axisStarts(phi_min, phi_max)
    "Start values of the positions of the axes that turn"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.AngularVelocity w_start[data.rotationalAxes] = zeros(data.rotationalAxes)
    "Start values of the speeds of the axes that turn"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Position s_start[data.translationalAxes] = UrdfSync.Dynamics.axisStarts(s_min, s_max)
    "Start values of the positions of the axes that slide"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Velocity v_start[data.translationalAxes] = zeros(data.translationalAxes)
    "Start values of the speeds of the axes that slide"
    annotation (Dialog(tab="Initialization"));

  final parameter Integer n = data.movingJoints
    "Number of moving joints";

  final parameter Integer nLinks = size(data.linkBodies, 1)
    "Number of links";

  final parameter Integer nFollowers = size(data.followers, 1)
    "Number of moving joints that follow others";

  final parameter Modelica.Units.SI.Angle phi_min[data.rotationalAxes] =
    UrdfSync.Dynamics.axisValues(axisEnds[:, 1], data.rotationalJoints)
    "Smallest positions of the axes that turn, with those of joints that follow them respected";

  final parameter Modelica.Units.SI.Angle phi_max[data.rotationalAxes] =
    UrdfSync.Dynamics.axisValues(axisEnds[:, 2], data.rotationalJoints)
    "Largest positions of the axes that turn, likewise";

  final parameter Modelica.Units.SI.AngularVelocity w_max[data.rotationalAxes] =
    UrdfSync.Dynamics.axisValues(axisVelocities, data.rotationalJoints)
    "Largest speeds of the axes that turn, likewise";

  final parameter Modelica.Units.SI.Position s_min[data.translationalAxes] =
    unitLength*UrdfSync.Dynamics.axisValues(axisEnds[:, 1], data.translationalJoints)
    "Smallest positions of the axes that slide, likewise";

  final parameter Modelica.Units.SI.Position s_max[data.translationalAxes] =
    unitLength*UrdfSync.Dynamics.axisValues(axisEnds[:, 2], data.translationalJoints)
    "Largest positions of the axes that slide, likewise";

  final parameter Modelica.Units.SI.Velocity v_max[data.translationalAxes] =
    unitLength*UrdfSync.Dynamics.axisValues(axisVelocities, data.translationalJoints)
    "Largest speeds of the axes that slide, likewise";

  final parameter Modelica.Units.SI.Mass m = sum(data.linkMasses)
    "Mass of the whole robot";

  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a
    "Frame of the root link"
    annotation (Placement(transformation(extent={{-116, -16}, {-84, 16}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b frame_b
    "Frame of the link tool, to attach things to"
    annotation (Placement(transformation(extent={{84, -16}, {116, 16}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a rotationalAxis[data.rotationalAxes]
    "Drives"
    annotation (Placement(transformation(extent={{-70, 90}, {-50, 110}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b rotationalSupport[data.rotationalAxes]
    "Housings of the drives"
    annotation (Placement(transformation(extent={{-40, 90}, {-20, 110}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a translationalAxis[data.translationalAxes]
    "Drives"
    annotation (Placement(transformation(extent={{20, 90}, {40, 110}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b translationalSupport[data.translationalAxes]
    "Housings of the drives"
    annotation (Placement(transformation(extent={{50, 90}, {70, 110}})));

  output Modelica.Units.SI.Position r_0[nLinks, 3]
    "Per link: origin of its frame, resolved in the world frame";

  output Real R_0[nLinks, 3, 3](each unit = "1")
    "Per link: rotation of its frame, v_world = R_0[k, :, :]*v_link";

  Modelica.Units.SI.Angle phi[data.rotationalAxes](
    start = phi_start,
    each fixed = fixedStart,
    each stateSelect = StateSelect.prefer)
    "Positions of the axes that turn";

  Modelica.Units.SI.AngularVelocity w_phi[data.rotationalAxes](
    start = w_start,
    each fixed = fixedStart,
    each stateSelect = StateSelect.prefer)
    "Speeds of the axes that turn";

  Modelica.Units.SI.AngularAcceleration a_phi[data.rotationalAxes]
    "Accelerations of the axes that turn";

  Modelica.Units.SI.Position s[data.translationalAxes](
    start = s_start,
    each fixed = fixedStart,
    each stateSelect = StateSelect.prefer)
    "Positions of the axes that slide";

  Modelica.Units.SI.Velocity v_s[data.translationalAxes](
    start = v_start,
    each fixed = fixedStart,
    each stateSelect = StateSelect.prefer)
    "Speeds of the axes that slide";

  Modelica.Units.SI.Acceleration a_s[data.translationalAxes]
    "Accelerations of the axes that slide";

  UrdfSync.Types.JointPosition q[n]
    "Positions of the moving joints";

  UrdfSync.Types.JointVelocity v[n]
    "Velocities of the moving joints";

  UrdfSync.Types.JointAcceleration a[n]
    "Accelerations of the moving joints";

  UrdfSync.Types.JointEffort effort[n]
    "Efforts that move what is behind the joints, and the inertia of their drives";

  UrdfSync.Types.JointEffort load[n]
    "The same with losses and with the loads of joints that follow";

  UrdfSync.Types.JointEffort drive[n]
    "Efforts of the drives; zero for joints that follow";

protected
  outer Modelica.Mechanics.MultiBody.World world
    "Gravity, and whether there is an animation";

  constant Modelica.Units.SI.Length unitLength = UrdfSync.Dynamics.unitLength
    "Makes numbers without unit of the positions of joints that slide: they share vectors with those that turn";

  parameter Integer driven[n] = UrdfSync.Dynamics.drivenJoints(n, data.followers)
    "1 for joints with a drive, 0 for those that follow"
    annotation (Evaluate=true);

  parameter UrdfSync.Types.JointPosition lower[n] = UrdfSync.Dynamics.jointVector(
    n,
    data.turning,
    data.turningLimits.lower,
    data.sliding,
    data.slidingLimits.lower,
    1/unitLength)
    "Smallest positions of the moving joints";

  parameter UrdfSync.Types.JointPosition upper[n] = UrdfSync.Dynamics.jointVector(
    n,
    data.turning,
    data.turningLimits.upper,
    data.sliding,
    data.slidingLimits.upper,
    1/unitLength)
    "Largest positions of the moving joints";

  parameter UrdfSync.Types.JointVelocity velocity[n] = UrdfSync.Dynamics.jointVector(
    n,
    data.turning,
    data.turningLimits.velocity,
    data.sliding,
    data.slidingLimits.velocity,
    1/unitLength)
    "Largest velocities of the moving joints";

  parameter UrdfSync.Types.JointAcceleration acceleration[n] = UrdfSync.Dynamics.jointVector(
    n,
    data.turning,
    data.turningLimits.acceleration,
    data.sliding,
    data.slidingLimits.acceleration,
    1/unitLength)
    "Largest accelerations of the moving joints";

  parameter UrdfSync.Types.JointAcceleration deceleration[n] = UrdfSync.Dynamics.jointVector(
    n,
    data.turning,
    data.turningLimits.deceleration,
    data.sliding,
    data.slidingLimits.deceleration,
    1/unitLength)
    "The same where they slow down";

  parameter UrdfSync.Types.JointEffort effortLimits[n] = UrdfSync.Dynamics.jointVector(
    n,
    data.turning,
    data.turningLimits.effort,
    data.sliding,
    data.slidingLimits.effort,
    unitLength)
    "Largest efforts of the moving joints";

  parameter UrdfSync.Types.JointPosition axisEnds[n, 2] =
    UrdfSync.Dynamics.axisEnds(lower, upper, data.followers, data.followerMultipliers, followerOffsets)
    "Ranges of the moving joints, those of joints that follow included: {smallest position, largest position}";

  parameter UrdfSync.Types.JointVelocity axisVelocities[n] =
    UrdfSync.Dynamics.axisVelocities(velocity, data.followers, data.followerMultipliers)
    "Largest velocities of the moving joints, those of joints that follow included";

  parameter UrdfSync.Types.JointPosition followerOffsets[nFollowers] = data.followerAngles + data.followerLengths/unitLength
    "Positions of the joints that follow where their leaders are at zero";

  parameter Real shares[n, nFollowers + 1](each unit = "1") = UrdfSync.Dynamics.followerShares(n, data.followers, data.followerMultipliers)
    "Motion of each follower per motion of its leader; the last column is empty, so that there is one";

  parameter UrdfSync.Types.JointPosition q_start[n] = UrdfSync.Dynamics.startPositions(
    n,
    data.rotationalJoints,
    phi_start,
    data.translationalJoints,
    s_start,
    data.followers,
    data.followerMultipliers,
    followerOffsets)
    "Positions of the moving joints at the start values";

  parameter Modelica.Units.SI.MomentOfInertia jointInertias[n] = UrdfSync.Dynamics.jointInertias(data.tree, q_start)
    "Inertias that joints move at the start values, joints that follow them aside";

  parameter Modelica.Units.SI.MomentOfInertia axisInertias[n] = UrdfSync.Dynamics.axisInertias(jointInertias, data.followers, data.followerMultipliers)
    "The same, joints that follow them included";

  // rumoca does not find a table of strings where it is a modifier of an array of components.
  parameter String kinds[data.drawnShapes] = data.visuals.kinds
    "Shape types";

  parameter Real e_length[data.drawnShapes, 3](each unit = "1") =
    UrdfSync.Functions.shapeAxes(data.visuals.angles, data.visuals.lengthAxes)
    "Directions of the lengths of the shapes, resolved in the link frames";

  parameter Real e_width[data.drawnShapes, 3](each unit = "1") =
    UrdfSync.Functions.shapeAxes(data.visuals.angles, fill(2, data.drawnShapes))
    "Directions of their widths, likewise";

  parameter Modelica.Units.SI.Position r_shape[data.drawnShapes, 3] =
    UrdfSync.Functions.shapeOrigins(data.visuals.positions, data.visuals.starts, e_length)
    "Points at which the shapes begin, likewise";

  Modelica.Mechanics.MultiBody.Visualizers.Advanced.Shape shape[data.drawnShapes](
    shapeType = kinds,
    length = data.visuals.sizes[:, 1],
    width = data.visuals.sizes[:, 2],
    height = data.visuals.sizes[:, 3],
    lengthDirection = e_length,
    widthDirection = e_width,
    r_shape = r_shape,
    color = data.visuals.colors,
    r = {r_0[data.visuals.links[k], :] for k in 1:data.drawnShapes},
    R = {Modelica.Mechanics.MultiBody.Frames.Orientation(
      T = transpose(R_0[data.visuals.links[k], :, :]),
      w = zeros(3)) for k in 1:data.drawnShapes}) if world.enableAnimation and animation
    "Visuals of the links";

  UrdfSync.Types.JointEffort loss[n]
    "Efforts that damping, dry friction and mechanisms take";

  UrdfSync.Types.JointEffort followerLoad[nFollowers + 1]
    "Loads of the joints that follow others";

equation
  assert(n == size(data.moveableJoints, 1),
    getInstanceName() + ": robot " + data.name + " has planar, floating or ball joints, so its record has no tables. Use the package approach, or write in the "
    + "URDF a planar joint as two prismatic joints and a continuous one, and leave out a floating joint at the root: put the robot on a FreeBase");
  for i in 1:n loop
    assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(lower[i], q[i])),
      getInstanceName() + " (joint " + data.jointNames[i].name + ") is below its lower position limit", AssertionLevel.warning);
    assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(q[i], upper[i])),
      getInstanceName() + " (joint " + data.jointNames[i].name + ") is above its upper position limit", AssertionLevel.warning);
    assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(abs(v[i]), velocity[i])),
      getInstanceName() + " (joint " + data.jointNames[i].name + ") is faster than its velocity limit", AssertionLevel.warning);
    assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(abs(drive[i]), effortLimits[i])),
      getInstanceName() + " (joint " + data.jointNames[i].name + ") is driven above its effort limit", AssertionLevel.warning);
    assert(noEvent(not checkLimits or a[i]*v[i] < 0 or UrdfSync.Functions.isAtMost(abs(a[i]), acceleration[i])),
      getInstanceName() + " (joint " + data.jointNames[i].name + ") speeds up faster than its acceleration limit", AssertionLevel.warning);
    assert(noEvent(not checkLimits or a[i]*v[i] >= 0 or UrdfSync.Functions.isAtMost(abs(a[i]), deceleration[i])),
      getInstanceName() + " (joint " + data.jointNames[i].name + ") slows down faster than its deceleration limit", AssertionLevel.warning);
    assert(not fixedStart or driven[i] == 0 or axisInertias[i] > 0,
      getInstanceName() + " (joint " + data.jointNames[i].name + ") has no inertia about or along its axis: it can be driven by position only", AssertionLevel.warning);
    load[i] = effort[i] + loss[i] + shares[i, :]*followerLoad;
    drive[i] = driven[i]*load[i];
  end for;

  for k in 1:data.turningJoints loop
    loss[data.turning[k]] = data.turningLosses[k].damping*v[data.turning[k]]
      + data.turningLosses[k].friction*tanh(0.5*data.turningLosses[k].steepness*v[data.turning[k]])
      + data.turningLosses[k].springStiffness*(q[data.turning[k]] - data.turningLosses[k].springReference);
  end for;

  for k in 1:data.slidingJoints loop
    loss[data.sliding[k]] = unitLength*(data.slidingLosses[k].damping*unitLength*v[data.sliding[k]]
      + data.slidingLosses[k].friction*tanh(0.5*data.slidingLosses[k].steepness*unitLength*v[data.sliding[k]])
      + data.slidingLosses[k].springStiffness*(unitLength*q[data.sliding[k]] - data.slidingLosses[k].springReference));
  end for;

  for k in 1:data.rotationalAxes loop
    rotationalSupport[k].phi = 0;
    phi[k] = rotationalAxis[k].phi - rotationalSupport[k].phi;
    w_phi[k] = der(phi[k]);
    a_phi[k] = der(w_phi[k]);
    q[data.rotationalJoints[k]] = phi[k];
    v[data.rotationalJoints[k]] = w_phi[k];
    a[data.rotationalJoints[k]] = a_phi[k];
    rotationalAxis[k].tau = drive[data.rotationalJoints[k]];
  end for;

  for k in 1:data.translationalAxes loop
    translationalSupport[k].s = 0;
    s[k] = translationalAxis[k].s - translationalSupport[k].s;
    v_s[k] = der(s[k]);
    a_s[k] = der(v_s[k]);
    unitLength*q[data.translationalJoints[k]] = s[k];
    unitLength*v[data.translationalJoints[k]] = v_s[k];
    unitLength*a[data.translationalJoints[k]] = a_s[k];
    unitLength*translationalAxis[k].f = drive[data.translationalJoints[k]];
  end for;

  // rumoca evaluates q[data.followers[k, 2]] also where the leader does not move and its number is 0: hence the max.
  for k in 1:nFollowers loop
    q[data.followers[k, 1]] = (if data.followers[k, 2] > 0 then data.followerMultipliers[k]*q[max(1, data.followers[k, 2])] else 0) + followerOffsets[k];
    v[data.followers[k, 1]] = if data.followers[k, 2] > 0 then data.followerMultipliers[k]*v[max(1, data.followers[k, 2])] else 0;
    a[data.followers[k, 1]] = if data.followers[k, 2] > 0 then data.followerMultipliers[k]*a[max(1, data.followers[k, 2])] else 0;
    followerLoad[k] = load[data.followers[k, 1]];
  end for;
  followerLoad[nFollowers + 1] = 0;

  annotation (Documentation(info="<html>
<p>
The record <code>data</code> says how many links and axes there are and how they hang together; so <code>data</code> is to be redeclared as the
record of a robot, in the declaration of the component:
<code>UrdfSync.Robots.GenericRobot robot(redeclare parameter MyRobotParameters data)</code>. A bench for several robots names a replaceable record there, as
<a href=\"modelica://UrdfSync.Examples.GenericRobot\">Examples.GenericRobot</a> does. Numbers of the record can be changed between
simulations, integers and axes of joints cannot.
</p>
<p>
<code>frame_a</code> is connected to what carries the robot: to the world, or for a robot that moves freely to a
<a href=\"modelica://UrdfSync.Robots.FreeBase\">FreeBase</a>. Driven axes have flanges as the robot model of the package approach has them, in the same
order; where nothing is connected the axis moves freely. <code>frame_b</code> is the frame of the link <code>tool</code>: a body, a sensor or a contact that is connected to it is part of the
motion. The constants <code>data.&lt;joint&gt;Axis</code> are their numbers.
</p>
<p>
<i>Shapes.</i> The visuals of the links are drawn where the links are, with the animation of the Modelica Standard Library. A tool that does not find a file must not
stop for it: leave all shapes out by <code>animation = false</code>. Their numbers are those of <code>data.visuals</code>.
</p>
<p>
<i>Losses and mimic joints.</i> The equations of motion give <code>effort</code>, torque in N.m or force in N, of each joint. The drives have to give more:
</p>
<pre>
load  = effort + loss + sum(k*load_follower)
q     = k*q_leader + c                       of a joint that follows; k, c: multiplier, offset
drive = load                                 of a joint that does not follow
</pre>
<p>
The sum over the followers of a joint is the principle of virtual work. <code>loss</code> is what damping and dry friction take by the law of
<a href=\"modelica://UrdfSync.Friction.Rotational\">Friction</a>, less what the <a href=\"modelica://UrdfSync.Records.JointDynamics\">mechanisms</a> of the joint give.
</p>
<p>
<i>Units.</i> <code>q</code>, <code>v</code>, <code>a</code>, <code>effort</code>, <code>load</code> and <code>drive</code> hold joints that turn and joints that slide, by the metre
<code>unitLength</code>: see <a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a>.
</p>
<p>
<i>Limits</i> are checked as in the package approach: a warning names the joint. Another warning names a joint whose element on the diagonal of the mass
matrix is zero at the start values, joints that follow it included: what it moves has no mass, or no inertia about its axis. Its free motion has no solution. Whether
the matrix is singular for another reason, as with two joints on the same axis and nothing between them, is not checked here; <code>urdfsync</code> looks for that when it reads the URDF. A robot without any moving joint is a rigid body. Robots with planar or floating joints are refused by name when a simulation begins.
</p>
</html>"));
end PartialRecordRobot;
