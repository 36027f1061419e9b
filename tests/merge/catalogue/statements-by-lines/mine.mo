model A
algorithm
  x := 1;
  y := 2;
  z := 4;
end A;
