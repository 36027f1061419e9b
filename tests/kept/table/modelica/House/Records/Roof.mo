within House.Records;

record Roof "Numbers of roof"
  extends Modelica.Icons.Record;

  parameter Modelica.Units.SI.ThermalConductance conductance = 18;

  annotation (__urdfsync(id = "b7748d78-25da", base = "df220e6433d712c1"));
end Roof;
