model A
  Real x, y;
  Real w;
end A;
