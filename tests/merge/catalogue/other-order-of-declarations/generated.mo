model A
  Real a;
  Real b = 1;
  Real c;
end A;
