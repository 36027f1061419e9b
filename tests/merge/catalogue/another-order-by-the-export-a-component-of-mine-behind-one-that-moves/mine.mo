model A
  Real a;
  Real m;
  Real b;
  Real c;
end A;
