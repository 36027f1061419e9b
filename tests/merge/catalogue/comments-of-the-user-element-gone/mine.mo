model A
  A a;
  // 1
  B b(x = 1 /* 2 */); // 3
  C c;
end A;
