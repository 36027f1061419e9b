model A
  B b(x = 1, // 1
    // 2
    z = 3);
end A;
