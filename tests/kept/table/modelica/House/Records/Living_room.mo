within House.Records;

record Living_room "Numbers of living room"
  extends Modelica.Icons.Record;

  parameter Modelica.Units.SI.HeatCapacity capacity = 2400000;

  parameter Modelica.Units.SI.Temperature temperature = 292.15;

  annotation (__urdfsync(id = "bb344a9d-25da", base = "aa19c53563d3faac"));
end Living_room;
