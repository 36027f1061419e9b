model A
  B b(seed = 3000001);
end A;
