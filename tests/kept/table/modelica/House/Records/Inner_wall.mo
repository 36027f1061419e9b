within House.Records;

record Inner_wall "Numbers of inner wall"
  extends Modelica.Icons.Record;

  parameter Modelica.Units.SI.ThermalConductance conductance = 60;

  annotation (__urdfsync(id = "1156df48-25da", base = "187aa18aeb4fcbc6"));
end Inner_wall;
