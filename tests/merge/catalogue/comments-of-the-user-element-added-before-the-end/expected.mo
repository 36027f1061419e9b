model A
  A a;
  B b;
  // 1
end A;
