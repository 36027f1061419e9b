within UrdfSync.Robots;

model MultiBodyGenericRobot "Any robot, read from its record: multibody components that a connection matrix joins"
  extends UrdfSync.Robots.PartialRecordRobot;

  final parameter Integer nJoints = size(data.jointPositions, 1)
    "Number of joints, fixed ones included";

  Modelica.Mechanics.MultiBody.Parts.Body link[nLinks](
    each animation = false,
    m = data.linkMasses,
    r_CM = data.linkCenters,
    I_11 = I[:, 1, 1],
    I_22 = I[:, 2, 2],
    I_33 = I[:, 3, 3],
    I_21 = I[:, 2, 1],
    I_31 = I[:, 3, 1],
    I_32 = I[:, 3, 2])
    "Links"
    annotation (Placement(transformation(extent={{-60, -10}, {-40, 10}})));

  Modelica.Mechanics.MultiBody.Parts.FixedRotation origin[nJoints](
    each animation = false,
    r = data.jointPositions,
    each rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    each sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg(data.jointAngles[:, {3, 2, 1}]))
    "From the frames of the parent links to the joint frames"
    annotation (Placement(transformation(extent={{-20, -10}, {0, 10}})));

  Modelica.Mechanics.MultiBody.Joints.Revolute revolute[data.turningJoints](
    each animation = false,
    each useAxisFlange = true,
    n = data.jointAxes[data.turning, :])
    "Joints that turn"
    annotation (Placement(transformation(extent={{20, 20}, {40, 40}})));

  Modelica.Mechanics.MultiBody.Joints.Prismatic prismatic[data.slidingJoints](
    each animation = false,
    each useAxisFlange = true,
    n = data.jointAxes[data.sliding, :])
    "Joints that slide"
    annotation (Placement(transformation(extent={{20, -40}, {40, -20}})));

  Modelica.Mechanics.Rotational.Sources.Torque torque[data.turningJoints](each useSupport = true)
    "What moves the joints that turn"
    annotation (Placement(transformation(extent={{20, 60}, {40, 80}})));

  Modelica.Mechanics.Translational.Sources.Force force[data.slidingJoints](each useSupport = true)
    "What moves the joints that slide"
    annotation (Placement(transformation(extent={{20, -80}, {40, -60}})));

protected
  parameter Modelica.Units.SI.MomentOfInertia I[nLinks, 3, 3](each min = -Modelica.Constants.inf) =
    {UrdfSync.Functions.inertiaInLinkAxes(data.inertialAngles[k, :], data.linkInertias[k, :]) for k in 1:nLinks}
    "Inertia tensors of the links about their centres of mass, in link axes";

equation
  connect(frame_a, link[1].frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}}, color={95, 95, 95}, thickness=0.5));

  connect(link[tool].frame_a, frame_b)
    annotation (Line(points={{-60, 0}, {-66, 0}, {-66, -90}, {92, -90}, {92, 0}, {100, 0}}, color={95, 95, 95}, thickness=0.5));

  for k in 1:nJoints loop
    connect(link[data.connectionMatrix[k, 1]].frame_a, origin[k].frame_a)
      annotation (Line(points={{-60, 0}, {-66, 0}, {-66, -20}, {-26, -20}, {-26, 0}, {-20, 0}}, color={95, 95, 95}, thickness=0.5));
    if data.linkBodies[data.connectionMatrix[k, 2]] == data.linkBodies[data.connectionMatrix[k, 1]] then
      connect(origin[k].frame_b, link[data.connectionMatrix[k, 2]].frame_a)
        annotation (Line(points={{0, 0}, {6, 0}, {6, -20}, {-66, -20}, {-66, 0}, {-60, 0}}, color={95, 95, 95}, thickness=0.5));
    end if;
  end for;

  for k in 1:data.turningJoints loop
    connect(origin[data.moveableJoints[data.turning[k], 1]].frame_b, revolute[k].frame_a)
      annotation (Line(points={{0, 0}, {10, 0}, {10, 30}, {20, 30}}, color={95, 95, 95}, thickness=0.5));
    connect(revolute[k].frame_b, link[data.connectionMatrix[data.moveableJoints[data.turning[k], 1], 2]].frame_a)
      annotation (Line(points={{40, 30}, {50, 30}, {50, 50}, {-66, 50}, {-66, 0}, {-60, 0}}, color={95, 95, 95}, thickness=0.5));
    connect(torque[k].flange, revolute[k].axis)
      annotation (Line(points={{40, 70}, {46, 70}, {46, 44}, {30, 44}, {30, 40}}, color={0, 0, 0}));
    connect(torque[k].support, revolute[k].support)
      annotation (Line(points={{30, 60}, {24, 60}, {24, 40}}, color={0, 0, 0}));
    torque[k].tau = effort[data.turning[k]] - data.turningInertias[k]*a[data.turning[k]];
    revolute[k].phi = q[data.turning[k]];
  end for;

  for k in 1:data.slidingJoints loop
    connect(origin[data.moveableJoints[data.sliding[k], 1]].frame_b, prismatic[k].frame_a)
      annotation (Line(points={{0, 0}, {10, 0}, {10, -30}, {20, -30}}, color={95, 95, 95}, thickness=0.5));
    connect(prismatic[k].frame_b, link[data.connectionMatrix[data.moveableJoints[data.sliding[k], 1], 2]].frame_a)
      annotation (Line(points={{40, -30}, {50, -30}, {50, -50}, {-66, -50}, {-66, 0}, {-60, 0}}, color={95, 95, 95}, thickness=0.5));
    connect(force[k].flange, prismatic[k].axis)
      annotation (Line(points={{40, -70}, {46, -70}, {46, -16}, {38, -16}, {38, -24}}, color={0, 127, 0}));
    connect(force[k].support, prismatic[k].support)
      annotation (Line(points={{30, -80}, {14, -80}, {14, -16}, {26, -16}, {26, -24}}, color={0, 127, 0}));
    force[k].f = effort[data.sliding[k]]/unitLength - data.slidingMasses[k]*unitLength*a[data.sliding[k]];
    prismatic[k].s = unitLength*q[data.sliding[k]];
  end for;

  for k in 1:nLinks loop
    r_0[k, :] = link[k].frame_a.r_0;
    R_0[k, :, :] = transpose(link[k].frame_a.R.T);
  end for;

  annotation (Documentation(info="<html>
<p>
The formulation that Pign&egrave;de and Oldemeyer published (Modelica Conference 2025): arrays of multibody components, connected through index matrices.
It is the way to the parts of the Modelica Standard Library: sensors, bodies and contacts can be connected to <code>link[k].frame_a</code> of any link.
</p>
<p>
OpenModelica (sources of August 2026) translated it for a six-axis arm with mimic joints and simulated a free fall of 0.5 s, which agrees with
<a href=\"modelica://UrdfSync.Robots.GenericRobot\">GenericRobot</a> to 1e-7; that was before it had <code>frame_b</code> and shapes. By what its authors report, Dymola translates the
formulation. rumoca, the compiler behind <code>urdfsync check</code>, does not: it loses the subscripts of components in <code>connect</code>. So the tests of this library write arrays and loops
out for one robot of three moving joints, whose free motion agrees with the reference. Where it can't be translated,
<a href=\"modelica://UrdfSync.Robots.GenericRobot\">GenericRobot</a> does the same.
</p>
<p>
Axes, mimic joints, losses and limits are those of the other generic robots. Each joint is moved by a source of torque or force, whose effort follows from
the drive, the losses and the joints that follow.
</p>
</html>"));
end MultiBodyGenericRobot;
