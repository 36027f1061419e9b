model A
  B b(w = 3, x = 1);
end A;
