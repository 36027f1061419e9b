model A
  Real x, y, z;
end A;
