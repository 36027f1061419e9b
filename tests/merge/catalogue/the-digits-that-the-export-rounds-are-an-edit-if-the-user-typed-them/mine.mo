model A
  B b(m = 11.50000001, v = {1, 2.0000001});
end A;
