model A
  B b(m = 2.0);
end A;
