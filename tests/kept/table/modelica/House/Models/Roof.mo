within House.Models;

model Roof "roof"

  parameter Records.Roof parameters
    "Numbers of the wall";

  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_a port_a;

  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_b port_b;

  Modelica.Thermal.HeatTransfer.Components.ThermalConductor layer(G = parameters.conductance);

equation
  connect(port_a, layer.port_a);
  connect(layer.port_b, port_b);

  annotation (__urdfsync(id = "b7748d78-0ec0", base = "f2652321edaa7b48"));
// mine
end Roof;
