model A
  Real m = a.m + b.m;
end A;
