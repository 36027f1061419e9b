model A
  B b(x = 3, y = 2);
end A;
