within House.Models;

model Ceiling "ceiling"

  parameter Records.Ceiling parameters
    "Numbers of the wall";

  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_a port_a;

  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_b port_b;

  Modelica.Thermal.HeatTransfer.Components.ThermalConductor layer(G = parameters.conductance);

equation
  connect(port_a, layer.port_a);
  connect(layer.port_b, port_b);

  annotation (__urdfsync(id = "5d44a91c-0ec0", base = "53d5665f84bbf182"));
end Ceiling;
