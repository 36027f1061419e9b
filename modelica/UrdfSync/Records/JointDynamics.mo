within UrdfSync.Records;

package JointDynamics "Numbers of the <dynamics> element, for joints that turn and joints that slide"
  extends Modelica.Icons.RecordsPackage;

  record RotationalDynamics "Losses, mechanisms and armature of a turning joint"
    extends UrdfSync.Icons.Parameters;

    Modelica.Units.SI.RotationalDampingConstant damping(min = 0) = 0
      "Viscous damping";

    Modelica.Units.SI.Torque friction(min = 0) = 0
      "Dry friction";

    UrdfSync.Types.RotationalSteepness steepness = 100
      "How sharply the dry friction changes its sign around standstill";

    Modelica.Units.SI.Torque breakaway(min = 0) = friction
      "Torque at which a joint breaks loose that stands still; laws with stiction only";

    Modelica.Units.SI.AngularVelocity stribeckSpeed = 0.05
      "Speed at which the breakaway torque has nearly gone; LuGre only";

    Modelica.Units.SI.Angle bristleDeflection = 1e-4
      "Deflection of the bristles at which they slide; LuGre only";

    Modelica.Units.SI.Time bristleTime = 1e-3
      "Damping of the bristles, divided by their stiffness; LuGre only";

    Modelica.Units.SI.Inertia armature = 0
      "Inertia that the drive adds at the joint";

    Modelica.Units.SI.RotationalSpringConstant springStiffness(min = 0) = 0
      "Stiffness of the spring of the joint";

    Modelica.Units.SI.Angle springReference = 0
      "Position at which the spring is relaxed";
  end RotationalDynamics;

  record TranslationalDynamics "Losses, mechanisms and armature of a sliding joint"
    extends UrdfSync.Icons.Parameters;

    Modelica.Units.SI.TranslationalDampingConstant damping(min = 0) = 0
      "Viscous damping";

    Modelica.Units.SI.Force friction(min = 0) = 0
      "Dry friction";

    UrdfSync.Types.TranslationalSteepness steepness = 1000
      "How sharply the dry friction changes its sign around standstill";

    Modelica.Units.SI.Force breakaway(min = 0) = friction
      "Force at which a joint breaks loose that stands still; laws with stiction only";

    Modelica.Units.SI.Velocity stribeckSpeed = 0.005
      "Speed at which the breakaway force has nearly gone; LuGre only";

    Modelica.Units.SI.Position bristleDeflection = 1e-5
      "Deflection of the bristles at which they slide; LuGre only";

    Modelica.Units.SI.Time bristleTime = 1e-3
      "Damping of the bristles, divided by their stiffness; LuGre only";

    Modelica.Units.SI.Mass armature = 0
      "Mass that the drive adds at the joint";

    Modelica.Units.SI.TranslationalSpringConstant springStiffness(min = 0) = 0
      "Stiffness of the spring of the joint";

    Modelica.Units.SI.Position springReference = 0
      "Position at which the spring is relaxed";
  end TranslationalDynamics;

  annotation (Documentation(info="<html>
<p>
The <code>&lt;dynamics&gt;</code> element of URDF, and numbers of the friction laws that URDF does not have: <a href=\"modelica://UrdfSync.Friction\">Friction</a> describes
these laws. A joint has 90 % of its dry friction at <code>2.94/steepness</code>: turning at 0.03 rad/s, which is 1.7 degrees per second, sliding at 3 mm/s.
</p>
<p>
A mechanism gives the joint a torque, positive in the direction of positive <code>phi</code>:
</p>
<pre>
tau = springStiffness*(springReference - phi)     a spring
</pre>
<p>
For sliding joints read force for torque and <code>s</code> for <code>phi</code>.
</p>
</html>"));
end JointDynamics;
