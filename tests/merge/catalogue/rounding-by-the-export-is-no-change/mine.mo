model A
  B b(m = 99, v = {1, 3});
end A;
