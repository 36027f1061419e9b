model A
  Real r = a * b;
end A;
