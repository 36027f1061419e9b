model A
  B b(m = 1.15e1, n = 3);
end A;
