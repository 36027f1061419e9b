model A
equation
  connect(a, b);
  f(m) = n + o;
  f(g, h) = i*j;
  x = 1;
end A;
