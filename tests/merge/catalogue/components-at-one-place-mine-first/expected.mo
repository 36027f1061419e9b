model A
  Real x;
  Real m;

  Real g;

equation
  x = 1;
end A;
