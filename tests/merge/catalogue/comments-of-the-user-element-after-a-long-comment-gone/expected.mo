model A
  /* 1
  2 */
  C c;
end A;
