model A
  Real d;
  Real b;
  Real a;
  Real c;
end A;
