model A
  inner World w;
  B b if c;
  P p[2];
end A;
