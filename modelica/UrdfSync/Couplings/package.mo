within UrdfSync;

package Couplings "Mimic joints as ideal couplings of two axes"
  extends Modelica.Icons.Package;

  annotation (Documentation(info="<html>
<p>
A joint with a <code>&lt;mimic&gt;</code> element follows another joint:
</p>
<pre>
q_follower = k*q_leader + c        k: multiplier, c: offset
tau_leader = -k*tau_follower       at the axes, into the coupling
</pre>
<p>
The couplings hold this relation and hand the follower's load to the leader without loss, as a gear does (<code>q</code> in rad or m, <code>tau</code> in N.m or N). One model
per pair of kinds; the kind of the leader comes first. Chains of couplings are legal: the ratio of a chain is the product of its multipliers.
</p>
</html>"));
end Couplings;
