within UrdfSync.Records;

record TranslationalDynamics "Losses of a sliding joint"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.TranslationalDampingConstant damping(min = 0) = 0
    "Viscous damping";

  Modelica.Units.SI.Force friction(min = 0) = 0
    "Dry friction";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;dynamics&gt;</code> element of URDF.
</p>
</html>"));
end TranslationalDynamics;
