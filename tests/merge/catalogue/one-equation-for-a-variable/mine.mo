model A
equation
  x = 1; // m
end A;
