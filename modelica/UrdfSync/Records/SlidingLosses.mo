within UrdfSync.Records;

record SlidingLosses "Losses and springs of all joints that slide"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.TranslationalDampingConstant damping[:] = fill(0, 0)
    "Viscous damping";

  Modelica.Units.SI.Force friction[:] = fill(0, 0)
    "Dry friction";

  UrdfSync.Types.TranslationalSteepness steepness[:] = fill(0, 0)
    "How sharply the dry friction changes its sign around standstill";

  Modelica.Units.SI.TranslationalSpringConstant springStiffness[:] = zeros(size(damping, 1))
    "Stiffness of the springs";

  Modelica.Units.SI.Position springReference[:] = zeros(size(damping, 1))
    "Positions at which the springs are relaxed";

  annotation (Documentation(info="<html>
<p>
A table of <a href=\"modelica://UrdfSync.Records.Robot\">Records.Robot</a>: one number per joint, in the order of the joints. Each refers to the <a href=\"modelica://UrdfSync.Records.TranslationalDynamics\">dynamics</a> record of its joint.
</p>
</html>"));
end SlidingLosses;
