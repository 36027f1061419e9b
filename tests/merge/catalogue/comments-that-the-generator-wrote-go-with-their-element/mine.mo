model A
  A a(x = 1);
  // of b
  B b; // b
end A;
