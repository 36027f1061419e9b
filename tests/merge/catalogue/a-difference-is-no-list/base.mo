model A
  Real m = a - b;
end A;
