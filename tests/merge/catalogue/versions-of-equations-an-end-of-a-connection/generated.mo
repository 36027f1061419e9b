model A
equation
  connect(g, b);
  p + q = r;
  x = 1;
end A;
