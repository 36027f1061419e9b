model A
  Real c;
  Real b = 1;
  Real a;
end A;
