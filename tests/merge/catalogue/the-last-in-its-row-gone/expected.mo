model A
  B b(x = 3);
end A;
