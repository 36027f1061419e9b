within UrdfSync.Records;

record RigidBodyTree "Bodies and joints of a robot: what the functions of Dynamics read"
  extends UrdfSync.Icons.Parameters;

  Integer jointTree[:, 2] = fill(0, 0, 2)
    "One row per moving joint: {number of the body that carries it, 1 if it turns or 2 if it slides}";

  Integer linkBodies[:] = {1}
    "Per link: number of the body that it is part of; 1 is the base, i + 1 is what moving joint i moves";

  Real linkRotations[:, 3, 3](each unit = "1") = fill(0, 1, 3, 3)
    "Per link: rotation in its body, v_body = linkRotations[k, :, :]*v_link";

  Modelica.Units.SI.Position linkPositions[:, 3] = fill(0, 1, 3)
    "Per link: origin in its body";

  Real jointRotations[:, 3, 3](each unit = "1") = fill(0, 0, 3, 3)
    "Per moving joint: rotation at position zero in the body that carries it";

  Modelica.Units.SI.Position jointOrigins[:, 3] = fill(0, 0, 3)
    "Per moving joint: origin at position zero in the body that carries it";

  Real turnAxes[:, 3](each unit = "1") = fill(0, 0, 3)
    "Per moving joint: turn of its body per motion of the joint, in the joint frame; zero if it slides";

  Modelica.Units.SI.Position slideAxes[:, 3] = fill(0, 0, 3)
    "Per moving joint: displacement of its body per motion of the joint, in the joint frame; zero if it turns";

  Modelica.Units.SI.Mass bodyMasses[:] = {0}
    "Per body: mass";

  Real bodyMoments[:, 3](each unit = "kg.m") = fill(0, 1, 3)
    "Per body: mass times centre of mass, in its frame";

  Modelica.Units.SI.MomentOfInertia bodyInertias[:, 3, 3](each min = -Modelica.Constants.inf) = fill(0, 1, 3, 3)
    "Per body: inertia tensor about its origin, in its axes";

  Modelica.Units.SI.MomentOfInertia driveInertias[:] = fill(0, 0)
    "Per moving joint: what its drive adds to the inertia; where it slides to the mass, times the square of unitLength";

  annotation (Documentation(info="<html>
<p>
The component <code>tree</code> of <a href=\"modelica://UrdfSync.Records.Robot\">Records.Robot</a>, which follows from the numbers of links and joints.
<a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a> describes bodies, joints and units.
</p>
</html>"));
end RigidBodyTree;
