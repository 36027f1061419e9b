model A
equation
  connect(a, b);
  p + q = r;
  x = m;
  x = g;
end A;
