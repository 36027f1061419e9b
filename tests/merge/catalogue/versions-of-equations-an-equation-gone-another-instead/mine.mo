model A
equation
  connect(a, b);
  x = 1;
end A;
