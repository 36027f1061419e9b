model A
  B b(x = 1
    // 1
  );
end A;
