model A
equation
  x = 2; // m
end A;
