within House.Records;

record Outside "Numbers of outside"
  extends Modelica.Icons.Record;

  parameter Modelica.Units.SI.Temperature temperature = 268.15;

  annotation (__urdfsync(id = "9ebbde4a-25da", base = "358fac04bcd15f34"));
end Outside;
