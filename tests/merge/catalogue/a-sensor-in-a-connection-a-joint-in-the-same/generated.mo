model A
equation
  connect(a, g.a);
  connect(g.b, b);
end A;
