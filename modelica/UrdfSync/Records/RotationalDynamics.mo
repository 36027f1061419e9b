within UrdfSync.Records;

record RotationalDynamics "Losses of a turning joint"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.RotationalDampingConstant damping(min = 0) = 0
    "Viscous damping";

  Modelica.Units.SI.Torque friction(min = 0) = 0
    "Dry friction";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;dynamics&gt;</code> element of URDF.
</p>
</html>"));
end RotationalDynamics;
