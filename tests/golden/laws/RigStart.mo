within Rig;

record RigStart "Where joints of robot Rig begin"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.Angle waist = 0.5
    "Start position of joint \"waist\"";

  annotation (Documentation(info="<html>
<p>
Positions at which the joints begin, from the source or the configuration. All other joints begin at zero, or where their limits are closest to it. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end RigStart;
