within UrdfSync.Contacts;

partial model PartialContact "What all contacts have"
  extends UrdfSync.Icons.Contact;
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialOneFrame_a;

  outer UrdfSync.Contacts.Ground ground
    "The ground of the simulated model";

  parameter Modelica.Units.SI.TranslationalSpringConstant stiffness = ground.stiffness
    "Stiffness of one point"
    annotation (Dialog(group="Surface"));

  parameter Real damping(unit = "s/m") = 2*ground.dampingRatio/sqrt(Modelica.Constants.g_n*ground.load/stiffness)
    "Damping of one point, as part of its spring force"
    annotation (Dialog(group="Surface"));

  parameter Real viscosity(unit = "N.s/m") = 0
    "Damping of one point beside that, in parallel to its spring"
    annotation (Dialog(group="Surface"));

  parameter Real friction(unit = "1") = ground.friction
    "Coefficient of friction"
    annotation (Dialog(group="Surface"));

  parameter Modelica.Units.SI.Velocity slipSpeed =
    if ground.friction > 0 and friction > ground.friction then ground.slipSpeed*friction/ground.friction else ground.slipSpeed
    "Speed of sliding at which friction reaches 70 % of its limit: with more friction than that of the ground, a point creeps as fast under a load"
    annotation (Dialog(group="Surface"));

  parameter Modelica.Units.SI.Length minDepth = 0
    "Depth that a point may have without a force"
    annotation (Dialog(group="Surface"));

  Modelica.Units.SI.Velocity v_0[3]
    "Velocity of frame_a, resolved in the world frame";

  Modelica.Units.SI.Force f[3]
    "Force of the ground on the link, resolved in frame_a";

  Modelica.Units.SI.Torque t[3]
    "Torque of the ground on the link about the origin of frame_a, resolved in frame_a";

equation
  v_0 = der(frame_a.r_0);
  frame_a.f = -f;
  frame_a.t = -t;

  annotation (Documentation(info="<html>
<p>
Frame and variables of a contact between a shape of a link and <code>UrdfSync.Contacts.Ground</code>. Classes that extend it give
<code>f</code> and <code>t</code> by one function call. The surface is that of the ground, unless the link has numbers of its own.
</p>
</html>"));
end PartialContact;
