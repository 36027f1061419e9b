model A
equation
  a + b = 3*c;
end A;
