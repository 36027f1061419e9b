model A
  Real m = a - b + m;
end A;
