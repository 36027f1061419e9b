model A
  Real c;
  Real b;
  Real a;
end A;
