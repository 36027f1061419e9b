model A
  Real a;
  Real b; // m
end A;
