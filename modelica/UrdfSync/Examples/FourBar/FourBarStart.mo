within UrdfSync.Examples.FourBar;

record FourBarStart "Where joints of robot FourBar begin"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.Angle crank_pivot = 1.2
    "Start position of joint \"crank_pivot\"";

  Modelica.Units.SI.Angle crank_pin = -0.882420799338
    "Start position of joint \"crank_pin\"";

  Modelica.Units.SI.Angle rocker_pivot = 1.2066303549
    "Start position of joint \"rocker_pivot\"";

  Modelica.Units.SI.Angle crank_pivotReach = 1
    "Longest way of joint \"crank_pivot\" in Test, so that the loops stay closed";

  annotation (Documentation(info="<html>
<p>
Positions at which the joints begin. Those of joints in loops close these, as near to the source as that goes. All other joints begin at zero, or where their limits are closest to it. They may be edited: urdfsync then keeps the file and reports when the source says something new.
</p>
</html>"),
    __urdfsync(id = "18d63be1-06fd", base = "514d73a610a09bb2"));
end FourBarStart;
