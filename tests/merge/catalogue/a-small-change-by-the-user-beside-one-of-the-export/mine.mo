model A
  B b(m = 11.50000001, n = 1);
end A;
