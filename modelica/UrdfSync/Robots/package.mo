within UrdfSync;

package Robots "What robots and their benches are made of"
  extends UrdfSync.Icons.RobotPackage;

  annotation (Documentation(info="<html>
<p>
Base classes of generated robots, the benches that <code>…Run</code> and <code>…Test</code> models extend, and the motion of the quick check.
</p>
</html>"));
end Robots;
