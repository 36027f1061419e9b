model A
  Real c;
  Real g;
  Real a;
  Real m;
  Real b;
end A;
