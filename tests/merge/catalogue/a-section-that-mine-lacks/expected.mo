model A
  Real x;
  Real m;
equation
  x = 1;
end A;
