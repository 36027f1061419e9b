within Rig;

record RigStart "Where joints of robot Rig begin"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.Position lift = 0.25
    "Start position of joint \"lift\"";

  Modelica.Units.SI.Angle tilt = 0.5
    "Start position of joint \"tilt\"";

  annotation (Documentation(info="<html>
<p>
Positions at which the joints begin, from the source or the configuration. All other joints begin at zero, or where their limits are closest to it. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end RigStart;
