model A
  B b(x = 1, // 1
    w = 3,
    y = 2);
end A;
