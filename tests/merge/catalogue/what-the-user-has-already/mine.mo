model A
  B b(m = 2, x = 3) "d"; // m
end A;
