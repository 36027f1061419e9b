model A
  Real a;
  Real b;
  Real c;
  Real d;
end A;
