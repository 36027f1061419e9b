model A
equation
  connect(a, g);
  p + q = r;
  x = 1;
end A;
