model A
  A a;
  // 1
  /* 2 */
  // 3
  C c;
end A;
