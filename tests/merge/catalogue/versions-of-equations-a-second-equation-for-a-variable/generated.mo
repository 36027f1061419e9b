model A
equation
  connect(a, b);
  p + q = r;
  x = g;
end A;
