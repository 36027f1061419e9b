model A
  B b(seed = 3000002);
end A;
