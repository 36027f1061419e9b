model A
  Real a = 1;
  Real b;
end A;
