within Zoo;

package Twig "Robot Twig in one record"
  extends UrdfSync.Icons.RobotPackage;

  annotation (
    Documentation(info="<html>
<p>
Made by urdfsync from a URDF. <code>TwigGeneric</code> simulates the robot as <code>UrdfSync.Robots.GenericRobot</code> reads it from <code>TwigParameters</code>. Every file can be edited: urdfsync keeps what you changed, brings everything else up to date, and reports where both changed.
</p>
</html>"));
end Twig;
