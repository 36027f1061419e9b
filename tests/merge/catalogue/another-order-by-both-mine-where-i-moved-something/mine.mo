model A
  Real a;
  Real c;
  Real d;
  Real b;
end A;
