model A
  inner outer World w;
  B b(x = 1) if c;
  P p[3];
end A;
