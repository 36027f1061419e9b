model A
  import SI = Modelica.Units.SI;
  import Math;
  extends B(x = 2, y = 2);
  extends C;
end A;
