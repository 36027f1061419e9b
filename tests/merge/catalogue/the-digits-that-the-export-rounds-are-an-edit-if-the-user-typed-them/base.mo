model A
  B b(m = 11.5, v = {1, 2});
end A;
