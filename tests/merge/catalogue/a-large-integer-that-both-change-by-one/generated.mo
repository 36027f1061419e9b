model A
  B b(seed = 3000003);
end A;
