within House.Models;

model Living_room "living room"

  parameter Records.Living_room parameters
    "Numbers of the room";

  Modelica.Thermal.HeatTransfer.Interfaces.HeatPort_a port
    "To the walls";

  Modelica.Thermal.HeatTransfer.Components.HeatCapacitor air(
    C = parameters.capacity,
    T(start = parameters.temperature, fixed = true));

equation
  connect(air.port, port);

  annotation (__urdfsync(id = "bb344a9d-fb52", base = "a395854be4e7393d"));
end Living_room;
