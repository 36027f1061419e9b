within UrdfSync;

package Icons "Icons of the library and of generated packages"
  extends Modelica.Icons.IconsPackage;

  annotation (Documentation(info="<html>
<p>
Symbols as in kinematic diagrams. Links are blue; turning joints are orange, sliding ones green, planar ones purple, floating
ones teal, fixed ones grey. In joints and couplings the side that holds is on the left, the side that moves on the right.
Names of links, joints and robots stand below them, since the lines to the drives of joints and robots leave at the top.
</p>
</html>"));
end Icons;
