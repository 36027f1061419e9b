within UrdfSync.Friction;

model RotationalStiction "Viscous damping and dry friction that holds: below its breakaway torque the joint stands still"
  extends UrdfSync.Friction.PartialRotational;
  extends Modelica.Mechanics.Rotational.Interfaces.PartialFriction;

equation
  w_relfric = w;
  a_relfric = der(w);
  tau0 = parameters.friction;
  tau0_max = parameters.breakaway;
  free = false;
  tau = parameters.damping*w + (
    if locked then sa*unitTorque
    elseif startForward or pre(mode) == Forward and not startBackward then parameters.friction
    else -parameters.friction);

  annotation (Documentation(info="<html>
<pre>
tau = d*w + tau_d*sign(w)     while the joint turns
|tau| &lt;= tau_s, w = 0         while it is stuck
</pre>
<p>
with damping <code>d</code>, dry friction <code>tau_d</code> and breakaway torque <code>tau_s</code> of the record. The states, stuck or sliding in a direction, are those of
<code>BearingFriction</code> in the Modelica Standard Library, whose <code>PartialFriction</code> this is.
</p>
<p>
A stuck joint can't follow an acceleration that a drive prescribes: the drive has to act by a torque, or through a spring. A joint that follows another one has no stiction of its
own, since two that are stuck hold the same motion twice.
</p>
</html>"));
end RotationalStiction;
