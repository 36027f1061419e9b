model A
  B b(m = 1);
end A;
