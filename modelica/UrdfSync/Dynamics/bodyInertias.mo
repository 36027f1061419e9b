within UrdfSync.Dynamics;

function bodyInertias "Inertial parameters of each body: those of its links, added up"
  extends Modelica.Icons.Function;

  input Integer linkBodies[:]
    "Per link: number of the body that it is part of; 1 is the base";

  input Real links[size(linkBodies, 1), 12]
    "One row per link, as linkFrames gives them";

  input Modelica.Units.SI.Mass linkMasses[size(linkBodies, 1)]
    "Per link: mass";

  input Modelica.Units.SI.Position linkCenters[size(linkBodies, 1), 3]
    "Per link: centre of mass in the link frame";

  input Modelica.Units.SI.Angle inertialAngles[size(linkBodies, 1), 3]
    "Per link: roll, pitch and yaw of the inertial frame in the link frame";

  input Modelica.Units.SI.MomentOfInertia linkInertias[size(linkBodies, 1), 6](each min = -Modelica.Constants.inf)
    "Per link: elements {xx, yy, zz, xy, xz, yz} in the inertial frame";

  input Integer n
    "Number of moving joints";

  output Real bodies[n + 1, 10]
    "One row per body: {m, m*c[3], xx, yy, zz, xy, xz, yz}, about the origin of the body and in its axes";

protected
  Real J[6] = zeros(6);
  Integer b = 1;
algorithm
  bodies := zeros(n + 1, 10);
  for k in 1:size(linkBodies, 1) loop
    b := linkBodies[k];
    J := linkInertias[k, :];
    bodies[b, :] := bodies[b, :] + UrdfSync.Dynamics.moved(
      UrdfSync.Dynamics.moved({linkMasses[k], 0, 0, 0, J[1], J[2], J[3], J[4], J[5], J[6]}, UrdfSync.Functions.rotation(inertialAngles[k, :]), linkCenters[k, :]),
      UrdfSync.Dynamics.rotationOf(links[k, :]), links[k, 10:12]);
  end for;

  annotation (Documentation(info="<html>
<p>
All ten parameters of a body are sums over its links, taken in the order of the links; a link without mass adds nothing.
</p>
</html>"));
end bodyInertias;
