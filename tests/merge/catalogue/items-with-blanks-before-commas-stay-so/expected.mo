model A
  B b(x = 1 , y = 3 , z = 4);
end A;
