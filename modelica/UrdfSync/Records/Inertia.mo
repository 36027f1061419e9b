within UrdfSync.Records;

record Inertia "Inertia tensor about the centre of mass"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.MomentOfInertia ixx = 0
    "Element (x, x)";

  Modelica.Units.SI.MomentOfInertia iyy = 0
    "Element (y, y)";

  Modelica.Units.SI.MomentOfInertia izz = 0
    "Element (z, z)";

  Modelica.Units.SI.MomentOfInertia ixy(min = -Modelica.Constants.inf) = 0
    "Element (x, y), as in the tensor itself: not the product of inertia with its sign changed";

  Modelica.Units.SI.MomentOfInertia ixz(min = -Modelica.Constants.inf) = 0
    "Element (x, z), as in the tensor itself: not the product of inertia with its sign changed";

  Modelica.Units.SI.MomentOfInertia iyz(min = -Modelica.Constants.inf) = 0
    "Element (y, z), as in the tensor itself: not the product of inertia with its sign changed";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;inertia&gt;</code> element of URDF: the six independent elements of the symmetric inertia
tensor, resolved in the inertial frame.
</p>
</html>"));
end Inertia;
