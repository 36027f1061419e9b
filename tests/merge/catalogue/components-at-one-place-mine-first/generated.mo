model A
  Real x;

  Real g;

equation
  x = 1;
end A;
