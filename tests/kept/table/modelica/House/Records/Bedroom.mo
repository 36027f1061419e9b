within House.Records;

record Bedroom "Numbers of bedroom"
  extends Modelica.Icons.Record;

  parameter Modelica.Units.SI.HeatCapacity capacity = 1500000;

  parameter Modelica.Units.SI.Temperature temperature = 290.15;

  annotation (__urdfsync(id = "aa7da745-25da", base = "f3fd87673c3efbc8"));
end Bedroom;
