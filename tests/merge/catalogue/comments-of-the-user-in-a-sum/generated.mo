model A
  Real r = a.m + b.m + c.m;
end A;
