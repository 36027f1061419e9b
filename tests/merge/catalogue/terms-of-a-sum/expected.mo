model A
  Real m = b.m + mine.m + c.m;
end A;
