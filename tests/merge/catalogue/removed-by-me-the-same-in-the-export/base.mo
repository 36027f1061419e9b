model A
  Real a;
  Real b;
end A;
