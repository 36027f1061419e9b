model A
equation
  x = m;
  x = 2;
end A;
