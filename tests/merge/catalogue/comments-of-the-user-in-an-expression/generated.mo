model A
  Real r = a * c;
end A;
