within House.Models;

model Outer_wall "outer wall"

  parameter Records.Outer_wall parameters
    "Numbers of the wall";

  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_a port_a;

  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_b port_b;

  Modelica.Thermal.HeatTransfer.Components.ThermalConductor layer(G = parameters.conductance);

equation
  connect(port_a, layer.port_a);
  connect(layer.port_b, port_b);

  annotation (__urdfsync(id = "5fab6bd2-0ec0", base = "4a789d9f10bc26ac"));
end Outer_wall;
