model A
equation
  x = 1;
end A;
