model A
  Real m = a.m + mine.m;
end A;
