model A
  Real a;
  Real b;
  Real c;
end A;
