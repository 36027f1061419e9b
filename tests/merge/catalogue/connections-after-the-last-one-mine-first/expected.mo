model A
equation
  connect(a, b);
  connect(m, n);
  connect(g, h);
end A;
