model A
  B b(m = 11.5, n = 2);
end A;
