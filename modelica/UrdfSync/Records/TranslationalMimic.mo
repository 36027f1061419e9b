within UrdfSync.Records;

record TranslationalMimic "How a sliding joint follows another joint"
  extends UrdfSync.Icons.Parameters;

  Real multiplier = 1
    "m of this joint per rad or m of the leader";

  Modelica.Units.SI.Position offset = 0
    "Position of this joint where the leader is at zero";

  annotation (Documentation(info="<html>
<p>
The numbers of the <code>&lt;mimic&gt;</code> element of URDF: position = multiplier * (position of the leader) + offset.
</p>
</html>"));
end TranslationalMimic;
