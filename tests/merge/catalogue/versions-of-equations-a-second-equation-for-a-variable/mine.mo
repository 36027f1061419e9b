model A
equation
  connect(a, b);
  p + q = r;
  x = 1;
  x = m;
end A;
