within UrdfSync.Dynamics;

function bodyMasses "Mass of each body"
  extends Modelica.Icons.Function;

  input Integer linkBodies[:]
    "Per link: number of the body that it is part of; 1 is the base";

  input Modelica.Units.SI.Mass linkMasses[:]
    "Per link: mass";

  input Integer n
    "Number of moving joints";

  output Modelica.Units.SI.Mass m[n + 1]
    "Per body: mass of all its links";

algorithm
  m := zeros(n + 1);
  for k in 1:size(linkBodies, 1) loop
    m[linkBodies[k]] := m[linkBodies[k]] + linkMasses[k];
  end for;

  annotation (Documentation(info="<html>
<p>
<code>m = sum(m_link)</code>
</p>
</html>"));
end bodyMasses;
