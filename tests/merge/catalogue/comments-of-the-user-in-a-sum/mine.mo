model A
  Real r = a.m + // 1
    b.m;
end A;
