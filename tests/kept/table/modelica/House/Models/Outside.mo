within House.Models;

model Outside "outside"

  parameter Records.Outside parameters
    "Its temperature";

  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_b port;

  Modelica.Thermal.HeatTransfer.Sources.FixedTemperature air(T = parameters.temperature);

equation
  connect(air.port, port);

  annotation (__urdfsync(id = "9ebbde4a-6a37", base = "e1e42a9bbdbbf3d5"));
end Outside;
