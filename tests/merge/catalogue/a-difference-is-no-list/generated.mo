model A
  Real m = a - b + g;
end A;
