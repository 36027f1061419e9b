within UrdfSync.Records;

record RotationalDynamics "Losses of a turning joint"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.RotationalDampingConstant damping(min = 0) = 0
    "Viscous damping";

  Modelica.Units.SI.Torque friction(min = 0) = 0
    "Dry friction";

  UrdfSync.Types.RotationalSteepness steepness = 100
    "How sharply the dry friction changes its sign around standstill";

  Modelica.Units.SI.Inertia armature = 0
    "Inertia that the drive adds at the joint";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;dynamics&gt;</code> element of URDF, and a number of the friction law that URDF does not have:
<a href=\"modelica://UrdfSync.Friction.Rotational\">Friction.Rotational</a> describes it. A joint has 90 % of its dry friction at
<code>2.94/steepness</code>: at 0.03 rad/s, which is 1.7 degrees per second.
</p>
</html>"));
end RotationalDynamics;
