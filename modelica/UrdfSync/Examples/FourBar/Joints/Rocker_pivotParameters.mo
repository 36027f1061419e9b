within UrdfSync.Examples.FourBar.Joints;

record Rocker_pivotParameters "Numbers of continuous joint \"rocker_pivot\" from link \"frame\" to link \"rocker\""
  extends UrdfSync.Records.ContinuousJoint(
    name = "rocker_pivot",
    origin(
      xyz = {0.5, 0, 0},
      rpy = {1.5707963267948966, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf));

  annotation (Documentation(info="<html>
<p>
Numbers of continuous joint &quot;rocker_pivot&quot; from link &quot;frame&quot; to link &quot;rocker&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "ab164d6a-352d", base = "d0e3a46df615e3b6"));
end Rocker_pivotParameters;
