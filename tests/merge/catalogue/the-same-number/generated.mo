model A
  B b(m = 2);
end A;
