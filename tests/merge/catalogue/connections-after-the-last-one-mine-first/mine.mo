model A
equation
  connect(a, b);
  connect(m, n);
end A;
