within UrdfSync.UsersGuide;

class Conventions "Frames, units, order, icons"
  extends Modelica.Icons.Information;

  annotation (
    preferredView="info",
    Documentation(info="<html>
<ul>
<li><em>Units</em> are SI units: m, kg, s, rad, N, N&middot;m, kg&middot;m&sup2;.</li>
<li><em>Orientation</em> is roll, pitch and yaw: turns about the fixed x, y and z axes of the parent frame, in this order. In the Modelica
Standard Library this is the sequence {3, 2, 1} with the angles {yaw, pitch, roll}.</li>
<li><em>Frames</em>: <code>frame_a</code> is on the side of the root, <code>frame_b</code> on the side of the leaves. Gravity acts along
-z of the world.</li>
<li><em>Flanges</em>: <code>axis</code> is driven, <code>support</code> is the housing.</li>
<li><em>Connectors</em> of a robot are named after their link or joint: <code>wristFrame</code>, <code>elbowAxis</code>, <code>elbowSupport</code>. Vectors of
flanges, and numbers in them, belong to the record approach.</li>
<li><em>Order</em>: links, joints, connectors and tables are depth-first from the root, siblings in natural order of their names
(<code>joint2</code> before <code>joint10</code>). The order of elements in the URDF does not matter.</li>
<li><em>Names</em>: a URDF name becomes a Modelica identifier. Components begin with a small letter, classes with a capital one. The
description string of every generated class holds the name as the URDF has it.</li>
<li><em>Records</em> hold numbers and strings only. Nothing in them switches a component on or off.</li>
<li><em>Absent numbers</em>: a missing origin is zero, a missing axis is {1, 0, 0}, a joint without <code>&lt;limit&gt;</code> has no
limits, a link without <code>&lt;inertial&gt;</code> has no mass.</li>
<li><em>Icons</em>: links are blue; turning joints are orange, sliding ones green, planar ones purple, floating ones teal, fixed ones grey.
Links show their mass, joints with one axis its direction.</li>
</ul>
</html>"));
end Conventions;
