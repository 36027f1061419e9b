model A
  A a; /* 1 */ B b; /* 2 */
end A;
