within Zoo.Mill.Joints;

record Die_pinParameters "Numbers of revolute joint \"die_pin\" that closes a loop from link \"rod\" to link \"die\""
  extends UrdfSync.Records.Loop(
    name = "die_pin",
    origin(
      xyz = {0.5, 0, 0},
      rpy = {0, 0, 0}),
    childOrigin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    translations = [1, 0, 0; 0, 1, 0],
    rotations = fill(0, 0, 3),
    childRotations = fill(0, 0, 3));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;die_pin&quot; that closes a loop from link &quot;rod&quot; to link &quot;die&quot;. They may be edited: urdfsync then keeps the file and reports when the source says something new.
</p>
</html>"));
end Die_pinParameters;
