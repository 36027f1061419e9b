within House;

model House "Rooms and walls"

  Models.Living_room living_room
    "living room";

  Models.Bedroom bedroom
    "bedroom";

  Models.Attic attic
    "attic";

  Models.Outside outside
    "outside";

  Models.Outer_wall outer_wall
    "outer wall";

  Models.Window window
    "window";

  Models.Inner_wall inner_wall
    "inner wall";

  Models.Ceiling ceiling
    "ceiling";

  Models.Roof roof
    "roof";

  Models.Heater heater
    "heater";

equation
  connect(outer_wall.port_a, living_room.port);
  connect(outer_wall.port_b, outside.port);
  connect(window.port_a, bedroom.port);
  connect(window.port_b, outside.port);
  connect(inner_wall.port_a, living_room.port);
  connect(inner_wall.port_b, bedroom.port);
  connect(ceiling.port_a, living_room.port);
  connect(ceiling.port_b, attic.port);
  connect(roof.port_a, attic.port);
  connect(roof.port_b, outside.port);
  connect(heater.port_b, living_room.port);

  annotation (__urdfsync(id = "0d4fc4a7-272e", base = "073b79f12f533ddb"));
end House;
