model A
  B b(x = 1 , y = 2);
end A;
