within House.Models;

model Window "window"

  parameter Records.Window parameters
    "Numbers of the wall";

  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_a port_a;

  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_b port_b;

  Modelica.Thermal.HeatTransfer.Components.ThermalConductor layer(G = parameters.conductance);

equation
  connect(port_a, layer.port_a);
  connect(layer.port_b, port_b);

  annotation (__urdfsync(id = "a0c85b7b-0ec0", base = "d6b6689f50a3d2f6"));
end Window;
