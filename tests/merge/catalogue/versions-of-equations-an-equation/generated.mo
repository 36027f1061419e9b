model A
equation
  connect(a, b);
  p + q = r + s;
  x = 1;
end A;
