model A
  B b(m = 12, n = 2.0);
end A;
