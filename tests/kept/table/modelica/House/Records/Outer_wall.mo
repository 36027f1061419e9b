within House.Records;

record Outer_wall "Numbers of outer wall"
  extends Modelica.Icons.Record;

  parameter Modelica.Units.SI.ThermalConductance conductance = 35;

  annotation (__urdfsync(id = "5fab6bd2-25da", base = "caed78f79a5e9cee"));
end Outer_wall;
