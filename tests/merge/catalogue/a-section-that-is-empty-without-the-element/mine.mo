model A
  Real x; // m
equation
  x = 1;
end A;
