model A
equation
  connect(a, b);
  connect(g, h);
end A;
