model A
  A a; // 1
  B b;
end A;
