model A
equation
  x = 1;
  x = m;
end A;
