within UrdfSync;

package Couplings "Mimic joints as ideal couplings of two axes"
  extends Modelica.Icons.Package;

  annotation (Documentation(info="<html>
<p>
A joint with a <code>&lt;mimic&gt;</code> element follows another joint: follower = multiplier * leader + offset.
The couplings hold this relation and hand the follower's load to the leader without loss, as a gear does. One model
per pair of kinds; the kind of the leader comes first.
</p>
</html>"));
end Couplings;
