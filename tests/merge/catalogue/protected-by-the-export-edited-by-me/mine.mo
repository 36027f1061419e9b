model A
  Real x;
  Real y = 3;
end A;
