within House.Models;

model Heater "heater"

  parameter Records.Heater parameters
    "Its power";

  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_b port_b;

  Modelica.Thermal.HeatTransfer.Sources.FixedHeatFlow source(Q_flow = parameters.power);

equation
  connect(source.port, port_b);

  annotation (__urdfsync(id = "e5f82b44-53e4", base = "780f9781b299a2ae"));
end Heater;
