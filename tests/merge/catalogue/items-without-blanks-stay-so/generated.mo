model A
  B b(w = 0, x = 1, y = 3, z = 4);
end A;
