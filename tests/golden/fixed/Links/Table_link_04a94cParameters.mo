within Zoo.Menagerie.Links;

record Table_link_04a94cParameters "Numbers of link \"table\""
  extends UrdfSync.Records.Link(
    name = "table",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.5,
      inertia(
        ixx = 0.001,
        iyy = 0.001,
        izz = 0.001,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;table&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end Table_link_04a94cParameters;
