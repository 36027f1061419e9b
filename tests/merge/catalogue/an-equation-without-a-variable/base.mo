model A
equation
  a + b = c;
end A;
