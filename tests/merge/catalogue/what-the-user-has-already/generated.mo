model A
  B b(x = 3, m = 2.0) "d";
end A;
