model A
equation
  connect(a, b);
end A;
