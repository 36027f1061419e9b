model A
  Real m = a.m + b.m + mine.m;
end A;
