model A
equation
  a + b = 2*c;
end A;
