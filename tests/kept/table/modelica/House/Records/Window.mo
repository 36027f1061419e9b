within House.Records;

record Window "Numbers of window"
  extends Modelica.Icons.Record;

  parameter Modelica.Units.SI.ThermalConductance conductance = 12.5;

  annotation (__urdfsync(id = "a0c85b7b-25da", base = "025f1fd431f88974"));
end Window;
