within House.Records;

record Attic "Numbers of attic"
  extends Modelica.Icons.Record;

  parameter Modelica.Units.SI.HeatCapacity capacity = 800000;

  parameter Modelica.Units.SI.Temperature temperature = 281.15;

  annotation (__urdfsync(id = "86b0fedb-25da", base = "b370e3a557221b86"));
end Attic;
