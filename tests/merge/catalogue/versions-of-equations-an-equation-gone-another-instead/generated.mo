model A
equation
  connect(a, b);
  f(g, h) = i*j;
  x = 1;
end A;
