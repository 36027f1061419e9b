within UrdfSync.Contacts;

package Functions "Force and torque of the ground, one function per shape"
  extends Modelica.Icons.FunctionsPackage;

  annotation (Documentation(info="<html>
<p>
Everything is resolved in the frame of the link, and torques are about its origin. A shape is reduced to the few points that
can be its lowest; what a single point feels is in <code>UrdfSync.Contacts.Functions.point</code>.
</p>
</html>"));
end Functions;
