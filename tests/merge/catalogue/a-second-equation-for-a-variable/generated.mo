model A
equation
  x = 2;
end A;
