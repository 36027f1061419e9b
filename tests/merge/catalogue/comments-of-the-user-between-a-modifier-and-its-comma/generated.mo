model A
  B b(x = 5, y = 2, z = 3);
end A;
