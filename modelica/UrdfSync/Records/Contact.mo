within UrdfSync.Records;

record Contact "How the shapes of a link feel at the ground"
  extends UrdfSync.Icons.Parameters;

  Real mu(unit = "1") = 0
    "Coefficient of friction, in all directions";

  Modelica.Units.SI.TranslationalSpringConstant kp = 0
    "Stiffness of one point";

  Real kd(unit = "N.s/m") = 0
    "Damping of one point, in parallel to its spring and beside that of the ground";

  Modelica.Units.SI.Length minDepth = 0
    "Depth that a point may have without a force";

  annotation (Documentation(info="<html>
<p>
What the URDF says of a link in <code>&lt;gazebo reference&gt;</code> or <code>&lt;contact&gt;</code>. Only links of which it
says something have this record. The contacts of the link use those numbers that the URDF states, and the numbers of the
<a href=\"modelica://UrdfSync.Contacts.Ground\">ground</a> for all others. The damping of the ground stays: simulators with fixed steps damp contacts by these steps, and the <code>kd</code> of many robots
would let them bounce for seconds.
</p>
</html>"));
end Contact;
