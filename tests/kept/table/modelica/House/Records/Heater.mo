within House.Records;

record Heater "Numbers of heater"
  extends Modelica.Icons.Record;

  parameter Modelica.Units.SI.HeatFlowRate power = 1500;

  annotation (__urdfsync(id = "e5f82b44-25da", base = "fcc16145aef82335"));
end Heater;
