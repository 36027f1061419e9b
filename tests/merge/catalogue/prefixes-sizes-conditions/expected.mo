model A
  inner outer World w(g = 1);
  B b(x = 1) if c and d;
  P p[3] "d";
end A;
