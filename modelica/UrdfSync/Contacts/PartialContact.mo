within UrdfSync.Contacts;

partial model PartialContact "What all contacts have"
  extends UrdfSync.Icons.Contact;
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialOneFrame_a;

  outer UrdfSync.Contacts.Ground ground
    "The ground of the simulated model";

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
<code>f</code> and <code>t</code> by one function call.
</p>
</html>"));
end PartialContact;
