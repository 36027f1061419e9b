model A
equation
  connect(a, b);
  p + q = r;
  x = m;
  x = 2;
  x = g;
end A;
