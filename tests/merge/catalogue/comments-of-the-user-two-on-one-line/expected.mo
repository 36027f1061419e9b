model A
  A a; /* 1 */ B b(x = 1); /* 2 */
end A;
