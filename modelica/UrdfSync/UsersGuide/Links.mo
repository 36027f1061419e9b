within UrdfSync.UsersGuide;

class Links "Mass, inertia, shapes"
  extends Modelica.Icons.Information;

  annotation (
    preferredView="info",
    Documentation(info="<html>
<p>
A link is a rigid body. Its only frame, <code>frame_a</code>, is the link frame of the URDF; the joints before and after the link
connect there.
</p>
<h4>Mass and inertia</h4>
<p>
The numbers are those of the <code>&lt;inertial&gt;</code> element. Its origin places the inertial frame in the link frame: the centre
of mass is at <code>xyz</code>, and the tensor <code>J</code> is resolved in axes that <code>rpy</code> turns. In link axes it is
</p>
<blockquote><pre>
I = R*J*transpose(R),   R = Rz(yaw)*Ry(pitch)*Rx(roll)
</pre></blockquote>
<p>
about the centre of mass. <code>ixy</code>, <code>ixz</code> and <code>iyz</code> are elements of the tensor itself, not products of
inertia with the opposite sign.
</p>
<p>
A link without <code>&lt;inertial&gt;</code> has no mass: its record holds zeros. That is right for frames and tool centre points.
A moving joint that carries no mass at all has no acceleration that follows from the forces; drive its position, or put numbers into the
record.
</p>
<h4>Shapes</h4>
<p>
Every <code>&lt;visual&gt;</code> and every <code>&lt;collision&gt;</code> is a component of its own with a record of its own. Visuals
are drawn if <code>animation</code> is true, collision shapes, in pink, if <code>showCollisions</code> is true. On a mobile robot the
collision shapes also <a href=\"modelica://UrdfSync.UsersGuide.MobileRobots\">touch the ground</a>. A mesh that was not found is left out.
</p>
<h4>Alone</h4>
<p>
The models in <a href=\"modelica://UrdfSync.Links\">UrdfSync.Links</a> take a replaceable record: they serve in any multibody model,
without a URDF.
</p>
</html>"));
end Links;
