model A
equation
  p + q = r;
  x = 1;
end A;
