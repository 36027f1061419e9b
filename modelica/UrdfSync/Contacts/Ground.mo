within UrdfSync.Contacts;

model Ground "Horizontal ground: one per simulated model, declared as inner"
  extends UrdfSync.Icons.Ground;

  outer Modelica.Mechanics.MultiBody.World world
    "World of the simulated model";

  parameter Modelica.Units.SI.Position height = 0
    "Height of the ground in the world frame";

  parameter Modelica.Units.SI.Force load(min = 0) = 1000
    "Weight of the robot"
    annotation (Dialog(group="Normal force"));

  parameter Modelica.Units.SI.Distance penetration(min = Modelica.Constants.eps) = 3e-4
    "Depth at which one point carries the load alone"
    annotation (Dialog(group="Normal force"));

  parameter Real dampingRatio(unit = "1", min = 0) = 2
    "Damping ratio of one point that carries the load alone; n points share it as dampingRatio/sqrt(n)"
    annotation (Dialog(group="Normal force"));

  parameter Real friction(unit = "1", min = 0) = 0.8
    "Coefficient of friction"
    annotation (Dialog(group="Friction"));

  parameter Modelica.Units.SI.Velocity slipSpeed(min = Modelica.Constants.eps) = 0.001
    "Speed of sliding at which friction reaches 70 % of its limit"
    annotation (Dialog(group="Friction"));

  parameter Boolean animation = true
    "= true, if the ground is drawn"
    annotation (Dialog(tab="Animation"));

  parameter Modelica.Units.SI.Length edge = 10
    "Edge of the square that is drawn"
    annotation (Dialog(tab="Animation", enable=animation));

  parameter Modelica.Mechanics.MultiBody.Types.Color color = {200, 205, 200}
    "Red, green and blue, 0 to 255"
    annotation (Dialog(tab="Animation", colorSelector=true, enable=animation));

  final parameter Modelica.Units.SI.TranslationalSpringConstant stiffness = load/penetration
    "Stiffness of one point";

  final parameter Real damping(unit = "s/m") = 2*dampingRatio/sqrt(Modelica.Constants.g_n*penetration)
    "Damping of one point, as part of its spring force";

protected
  Modelica.Mechanics.MultiBody.Visualizers.Advanced.Shape plate(
    shapeType = "box",
    color = color,
    length = edge,
    width = edge,
    height = 0.001*edge,
    lengthDirection = {1, 0, 0},
    widthDirection = {0, 1, 0},
    r = {0, 0, height - 0.0005*edge},
    r_shape = {-0.5*edge, 0, 0},
    specularCoefficient = 0.1) if world.enableAnimation and animation
    "Plate whose upper side is the ground"
    annotation (Placement(transformation(extent={{-10, -10}, {10, 10}})));

  annotation (
    defaultComponentName="ground",
    defaultComponentPrefixes="inner",
    missingInnerMessage="
Contacts need a ground: declare 'inner UrdfSync.Contacts.Ground ground' in the model that is simulated,
beside its world. A default ground at height 0 is used instead.",
    Documentation(info="<html>
<p>
The ground is the plane <code>z = height</code> of the world, whose gravity must act along <code>-z</code>. Declare it as
<code>inner</code> in the model that is simulated, with the weight of the robot as <code>load</code>.
</p>
<pre>
stiffness = load/penetration                              N/m
damping   = 2*dampingRatio/sqrt(g_n*penetration)          s/m
</pre>
<p>
The load sets the stiffness, so that light and heavy robots sink in by the same small depth: <code>penetration</code>
divided by the number of points that share the weight. A load that is too large makes the ground harder than necessary, which
costs time but no accuracy. The damping follows from the linear oscillator: a mass of weight <code>F</code> that rests at
depth <code>p</code> on a spring <code>F/p</code> with the damper <code>F*d</code> has the damping ratio
<code>d*sqrt(g*p)/2</code>, here with standard gravity. The default is critical for four points, such as the corners of a
box; eight points, such as both rims of four wheels, still have 0.7.
</p>
<p>
A robot that starts below the ground is not thrown up but lifted out slowly: the force ends at the upward speed
<code>1/damping</code>.
</p>
</html>"));
end Ground;
