model A
equation
  connect(g, h);
  p + q = r;
  x = 1;
end A;
