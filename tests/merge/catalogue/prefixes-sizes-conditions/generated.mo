model A
  inner World w(g = 1);
  B b if c and d;
  P p[2] "d";
end A;
