model A
equation
  connect(m, n);
  connect(g, h);
  p + q = r;
  x = 1;
end A;
