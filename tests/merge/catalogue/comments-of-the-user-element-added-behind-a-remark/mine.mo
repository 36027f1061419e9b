model A
  A a; // 1
end A;
