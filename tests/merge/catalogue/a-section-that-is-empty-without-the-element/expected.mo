model A
  Real x; // m
end A;
