within House.Models;

model Inner_wall "inner wall"

  parameter Records.Inner_wall parameters
    "Numbers of the wall";

  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_a port_a;

  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_b port_b;

  Modelica.Thermal.HeatTransfer.Components.ThermalConductor layer(G = parameters.conductance);

equation
  connect(port_a, layer.port_a);
  connect(layer.port_b, port_b);

  annotation (__urdfsync(id = "1156df48-0ec0", base = "16983826fa383e84"));
end Inner_wall;
