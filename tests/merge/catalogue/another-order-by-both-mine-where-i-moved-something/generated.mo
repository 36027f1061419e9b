model A
  Real d;
  Real a;
  Real b;
  Real c;
end A;
