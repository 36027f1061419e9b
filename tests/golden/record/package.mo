within Zoo;

package Twig "Robot Twig in one record"
  extends UrdfSync.Icons.RobotPackage;

  annotation (
    Documentation(info="<html>
<p>
Made by urdfsync from a URDF. Every file can be edited: urdfsync keeps what you changed, brings everything else up to date, and reports where both changed.
</p>
</html>"));
end Twig;
