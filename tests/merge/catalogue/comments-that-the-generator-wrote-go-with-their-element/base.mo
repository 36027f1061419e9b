model A
  A a;
  // of b
  B b; // b
end A;
