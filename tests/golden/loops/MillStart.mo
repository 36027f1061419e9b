within Zoo.Mill;

record MillStart "Where joints of robot Mill begin"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.Position block_181fd7 = 0.4
    "Start position of joint \"block\"";

  Modelica.Units.SI.Angle crank = 1.2
    "Start position of joint \"crank\"";

  Modelica.Units.SI.Angle arm_pin = -1.2
    "Start position of joint \"arm_pin\"";

  Modelica.Units.SI.Position ram = 0.3
    "Start position of joint \"ram\"";

  Modelica.Units.SI.Angle shoe_pin = 2.214297435588
    "Start position of joint \"shoe_pin\"";

  Modelica.Units.SI.Angle rocker = 1.2
    "Start position of joint \"rocker\"";

  Modelica.Units.SI.Angle crankReach = 1
    "Longest way of joint \"crank\" in Test, so that the loops stay closed";

  Modelica.Units.SI.Position ramReach = 0.1
    "Longest way of joint \"ram\" in Test, so that the loops stay closed";

  annotation (Documentation(info="<html>
<p>
Positions at which the joints begin. Those of joints in loops close these, as near to the source as that goes. All other joints begin at zero, or where their limits are closest to it. They may be edited: urdfsync then keeps the file and reports when the source says something new.
</p>
</html>"));
end MillStart;
