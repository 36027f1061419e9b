model A
equation
  connect(a, b);
  p + q = 2*r;
  x = 1;
end A;
