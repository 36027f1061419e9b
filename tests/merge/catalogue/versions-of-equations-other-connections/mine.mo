model A
equation
  connect(m, n);
  p + q = r;
  x = 1;
end A;
