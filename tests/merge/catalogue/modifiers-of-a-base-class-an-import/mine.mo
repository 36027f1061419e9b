model A
  import SI = Modelica.SIunits;
  import Math;
  extends B(x = 2);
end A;
