within UrdfSync.Examples.FourBar.Joints;

record Rocker_pinParameters "Numbers of revolute joint \"rocker_pin\" that closes a loop from link \"coupler\" to link \"rocker\""
  extends UrdfSync.Records.Loop(
    name = "rocker_pin",
    origin(
      xyz = {0.6, 0, -0.025},
      rpy = {0, 0, 0}),
    childOrigin(
      xyz = {0.4, 0, 0},
      rpy = {0, 0, 0}),
    translations = [1, 0, 0; 0, 1, 0],
    rotations = fill(0, 0, 3),
    childRotations = fill(0, 0, 3));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;rocker_pin&quot; that closes a loop from link &quot;coupler&quot; to link &quot;rocker&quot;. They may be edited: urdfsync then keeps the file and reports when the source says something new.
</p>
</html>"),
    __urdfsync(id = "c430855c-352d", base = "c3581b7d1742d433"));
end Rocker_pinParameters;
