within UrdfSync.Examples.FourBar.Joints;

record Crank_pivotParameters "Numbers of continuous joint \"crank_pivot\" from link \"frame\" to link \"crank\""
  extends UrdfSync.Records.ContinuousJoint(
    name = "crank_pivot",
    origin(
      xyz = {0, 0, 0},
      rpy = {1.5707963267948966, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf));

  annotation (Documentation(info="<html>
<p>
Numbers of continuous joint &quot;crank_pivot&quot; from link &quot;frame&quot; to link &quot;crank&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "5a816b4d-352d", base = "7b44f658de29d1e8"));
end Crank_pivotParameters;
