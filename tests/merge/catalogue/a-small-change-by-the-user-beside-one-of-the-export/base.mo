model A
  B b(m = 11.5, n = 1);
end A;
