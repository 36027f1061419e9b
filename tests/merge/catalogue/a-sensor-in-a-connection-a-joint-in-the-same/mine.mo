model A
equation
  connect(a, m.a);
  connect(m.b, b);
end A;
