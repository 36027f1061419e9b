model A
  import SI = Modelica.Units.SI;
  extends B(x = 1, y = 2);
  extends C;
end A;
