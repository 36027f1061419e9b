within Rig;

record RigSensors "Numbers of the sensors of robot Rig"
  extends UrdfSync.Icons.Parameters;

  UrdfSync.Records.Sensor load(
    name = "load",
    updateRate = 0,
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}))
    "Sensor \"load\" of joint \"tilt\"";

  annotation (Documentation(info="<html>
<p>
Numbers of the sensors of robot Rig. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end RigSensors;
