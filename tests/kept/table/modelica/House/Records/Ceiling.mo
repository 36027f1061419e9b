within House.Records;

record Ceiling "Numbers of ceiling"
  extends Modelica.Icons.Record;

  parameter Modelica.Units.SI.ThermalConductance conductance = 25;

  annotation (__urdfsync(id = "5d44a91c-25da", base = "076bd436851fde50"));
end Ceiling;
