model A
  Real m = a.m + mine.m + b.m;
end A;
