model A
  Real a = 1;
end A;
