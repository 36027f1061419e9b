within House.Models;

model Attic "attic"

  parameter Records.Attic parameters
    "Numbers of the room";

  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_a port
    "To the walls";

  Modelica.Thermal.HeatTransfer.Components.HeatCapacitor air(
    C = parameters.capacity,
    T(start = parameters.temperature, fixed = true));

equation
  connect(air.port, port);

  annotation (__urdfsync(id = "86b0fedb-fb52", base = "f990a7f1879973bd"));
end Attic;
