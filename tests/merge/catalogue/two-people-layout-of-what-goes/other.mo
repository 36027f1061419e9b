model A "An arm"
  Body body(
    m = 11.5,
    r = 2) annotation (Placement(transformation(extent={{-10, -10}, {10, 10}})));
equation
end A;
