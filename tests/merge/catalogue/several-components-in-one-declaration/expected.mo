model A
  Real x, y, z;
  Real w;
end A;
