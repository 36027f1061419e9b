model A
equation
  connect(a, b);
  f(m) = n + o;
  x = 1;
end A;
