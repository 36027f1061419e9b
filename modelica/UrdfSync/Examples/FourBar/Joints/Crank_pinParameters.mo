within UrdfSync.Examples.FourBar.Joints;

record Crank_pinParameters "Numbers of continuous joint \"crank_pin\" from link \"crank\" to link \"coupler\""
  extends UrdfSync.Records.ContinuousJoint(
    name = "crank_pin",
    origin(
      xyz = {0.2, 0, 0.025},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf));

  annotation (Documentation(info="<html>
<p>
Numbers of continuous joint &quot;crank_pin&quot; from link &quot;crank&quot; to link &quot;coupler&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "a03b3574-352d", base = "48ad12ae00b11ccd"));
end Crank_pinParameters;
