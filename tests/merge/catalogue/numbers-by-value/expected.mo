model A
  B b(m = 12, n = 3);
end A;
