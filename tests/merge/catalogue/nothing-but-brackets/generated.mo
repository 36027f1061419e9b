model A
  B b(y = 2);
end A;
