within UrdfSync.Dynamics;

function bodyMoments "First moment of mass of each body"
  extends Modelica.Icons.Function;

  input Integer linkBodies[:]
    "Per link: number of the body that it is part of; 1 is the base";

  input Real linkRotations[:, 3, 3](each unit = "1")
    "Per link: rotation in its body";

  input Modelica.Units.SI.Position linkPositions[:, 3]
    "Per link: origin in its body";

  input Modelica.Units.SI.Mass linkMasses[:]
    "Per link: mass";

  input Modelica.Units.SI.Position linkCenters[:, 3]
    "Per link: centre of mass in the link frame";

  input Integer n
    "Number of moving joints";

  output Real h[n + 1, 3](each unit = "kg.m")
    "Per body: mass times centre of mass, in the frame of the body";

algorithm
  h := zeros(n + 1, 3);
  for k in 1:size(linkBodies, 1) loop
    h[linkBodies[k], :] := h[linkBodies[k], :] + linkMasses[k]*(linkPositions[k, :] + linkRotations[k, :, :]*linkCenters[k, :]);
  end for;

  annotation (Documentation(info="<html>
<p>
<code>h = sum(m_link*(r_link + R_link*c_link))</code>. A centre of mass would need a division by the mass, and not every body has one.
</p>
</html>"));
end bodyMoments;
