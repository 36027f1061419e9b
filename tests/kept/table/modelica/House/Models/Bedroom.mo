within House.Models;

model Bedroom "bedroom"

  parameter Records.Bedroom parameters
    "Numbers of the room";

  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_a port
    "To the walls";

  Modelica.Thermal.HeatTransfer.Components.HeatCapacitor air(
    C = parameters.capacity,
    T(start = parameters.temperature, fixed = true));

equation
  connect(air.port, port);

  annotation (__urdfsync(id = "aa7da745-fb52", base = "a11b493d766be5fa"));
end Bedroom;
