model A
  B b(/* 1 */ x = 1);
end A;
