model A
  B b(x = 3, m = 2) "d"; // m
end A;
