model A
  Real c;
  Real g;
  Real a;
  Real b;
end A;
