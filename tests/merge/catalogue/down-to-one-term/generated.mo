model A
  Real m = a.m;
end A;
