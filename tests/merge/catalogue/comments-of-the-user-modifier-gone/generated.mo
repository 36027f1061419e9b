model A
  B b(x = 1, z = 3);
end A;
