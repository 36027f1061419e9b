model A "An arm"
  Body body(
    m = 11.5,
    r = 2) annotation (Placement(transformation(extent={{-10, -10}, {10, 10}})));
  Body tool(m = 3) annotation (Placement(transformation(extent={{30, -10}, {50, 10}})));
equation
  connect(body.b, tool.a);
end A;
