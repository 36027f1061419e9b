within UrdfSync.Robots;

partial model PartialBench "World with gravity along -z, as URDF has it"
  extends UrdfSync.Icons.Bench;

  inner Modelica.Mechanics.MultiBody.World world(n = {0, 0, -1})
    "Origin and gravity"
    annotation (Placement(transformation(extent={{-100, -60}, {-80, -40}})));

  annotation (Documentation(info="<html>
<p>
A robot of a fixed base is connected to <code>world.frame_b</code>.
</p>
</html>"));
end PartialBench;
