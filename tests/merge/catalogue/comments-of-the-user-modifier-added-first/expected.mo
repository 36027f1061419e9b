model A
  B b(w = 3, /* 1 */ x = 1);
end A;
