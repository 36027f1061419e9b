within UrdfSync.Friction;

model TranslationalStiction "Viscous damping and dry friction that holds: below its breakaway force the joint stands still"
  extends UrdfSync.Friction.PartialTranslational;
  extends Modelica.Mechanics.Translational.Interfaces.PartialFriction;

equation
  v_relfric = v;
  a_relfric = der(v);
  f0 = parameters.friction;
  f0_max = parameters.breakaway;
  free = false;
  f = parameters.damping*v + (
    if locked then sa*unitForce
    elseif startForward or pre(mode) == Forward and not startBackward then parameters.friction
    else -parameters.friction);

  annotation (Documentation(info="<html>
<p>
The law of <a href=\"modelica://UrdfSync.Friction.RotationalStiction\">RotationalStiction</a>, for a joint that slides.
</p>
</html>"));
end TranslationalStiction;
