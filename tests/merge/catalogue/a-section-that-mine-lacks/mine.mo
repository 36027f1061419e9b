model A
  Real x;
  Real m;
end A;
