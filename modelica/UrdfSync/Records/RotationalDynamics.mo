within UrdfSync.Records;

record RotationalDynamics "Losses and spring of a turning joint"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.RotationalDampingConstant damping(min = 0) = 0
    "Viscous damping";

  Modelica.Units.SI.Torque friction(min = 0) = 0
    "Dry friction";

  UrdfSync.Types.RotationalSteepness steepness = 100
    "How sharply the dry friction changes its sign around standstill";

  Modelica.Units.SI.Torque breakaway(min = 0) = friction
    "Torque at which a joint breaks loose that stands still; laws with stiction only";

  Modelica.Units.SI.AngularVelocity stribeckSpeed = 0.05
    "Speed at which the breakaway torque has nearly gone; LuGre only";

  Modelica.Units.SI.Angle bristleDeflection = 1e-4
    "Deflection of the bristles at which they slide; LuGre only";

  Modelica.Units.SI.Time bristleTime = 1e-3
    "Damping of the bristles, divided by their stiffness; LuGre only";

  Modelica.Units.SI.Inertia armature = 0
    "Inertia that the drive adds at the joint";

  Modelica.Units.SI.RotationalSpringConstant springStiffness(min = 0) = 0
    "Stiffness of the spring of the joint";

  Modelica.Units.SI.Angle springReference = 0
    "Position at which the spring is relaxed";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;dynamics&gt;</code> element of URDF, and numbers of the friction laws that URDF does not have:
<a href=\"modelica://UrdfSync.Friction.Rotational\">Friction.Rotational</a> describes it. A joint has 90 % of its dry friction at
<code>2.94/steepness</code>: at 0.03 rad/s, which is 1.7 degrees per second.
</p>
</html>"));
end RotationalDynamics;
