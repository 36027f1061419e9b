model A
  Real r = a.m +
    b.m;
end A;
