model A
  A a;
  // 1
  // 2
end A;
