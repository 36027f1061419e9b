model A
  Real a; // m
end A;
