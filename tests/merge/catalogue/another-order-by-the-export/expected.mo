model A
  Real b; // m
  Real a;
end A;
