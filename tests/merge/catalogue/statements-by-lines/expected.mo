model A
algorithm
  x := 7;
  y := 2;
  z := 4;
end A;
