within UrdfSync.Records;

record TranslationalDynamics "Losses and spring of a sliding joint"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.TranslationalDampingConstant damping(min = 0) = 0
    "Viscous damping";

  Modelica.Units.SI.Force friction(min = 0) = 0
    "Dry friction";

  UrdfSync.Types.TranslationalSteepness steepness = 1000
    "How sharply the dry friction changes its sign around standstill";

  Modelica.Units.SI.Force breakaway(min = 0) = friction
    "Force at which a joint breaks loose that stands still; laws with stiction only";

  Modelica.Units.SI.Velocity stribeckSpeed = 0.005
    "Speed at which the breakaway force has nearly gone; LuGre only";

  Modelica.Units.SI.Position bristleDeflection = 1e-5
    "Deflection of the bristles at which they slide; LuGre only";

  Modelica.Units.SI.Time bristleTime = 1e-3
    "Damping of the bristles, divided by their stiffness; LuGre only";

  Modelica.Units.SI.Mass armature = 0
    "Mass that the drive adds at the joint";

  Modelica.Units.SI.TranslationalSpringConstant springStiffness(min = 0) = 0
    "Stiffness of the spring of the joint";

  Modelica.Units.SI.Position springReference = 0
    "Position at which the spring is relaxed";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;dynamics&gt;</code> element of URDF, and numbers of the friction laws that URDF does not have:
<a href=\"modelica://UrdfSync.Friction.Translational\">Friction.Translational</a> describes it. A joint has 90 % of its dry friction at
<code>2.94/steepness</code>: at 3 mm/s.
</p>
</html>"));
end TranslationalDynamics;
