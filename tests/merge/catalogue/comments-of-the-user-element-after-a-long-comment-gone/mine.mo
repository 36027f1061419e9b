model A
  /* 1
  2 */ B b;
  C c;
end A;
