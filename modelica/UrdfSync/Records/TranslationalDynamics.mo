within UrdfSync.Records;

record TranslationalDynamics "Losses of a sliding joint"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.TranslationalDampingConstant damping(min = 0) = 0
    "Viscous damping";

  Modelica.Units.SI.Force friction(min = 0) = 0
    "Dry friction";

  UrdfSync.Types.TranslationalSteepness steepness = 1000
    "How sharply the dry friction changes its sign around standstill";

  Modelica.Units.SI.Mass armature = 0
    "Mass that the drive adds at the joint";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;dynamics&gt;</code> element of URDF, and a number of the friction law that URDF does not have:
<a href=\"modelica://UrdfSync.Friction.Translational\">Friction.Translational</a> describes it. A joint has 90 % of its dry friction at
<code>2.94/steepness</code>: at 3 mm/s.
</p>
</html>"));
end TranslationalDynamics;
