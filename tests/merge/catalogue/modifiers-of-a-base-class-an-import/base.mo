model A
  import SI = Modelica.SIunits;
  extends B(x = 1);
end A;
