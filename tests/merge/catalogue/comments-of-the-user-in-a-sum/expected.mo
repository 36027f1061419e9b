model A
  Real r = a.m + // 1
    b.m +
    c.m;
end A;
