model A
equation
  connect(a, m);
  p + q = r;
  x = 1;
end A;
