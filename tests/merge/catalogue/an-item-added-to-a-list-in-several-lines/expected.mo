model A
  B b(
    x = 1,
    y = 2,
    m = 4,
    z = 3);
end A;
