model A
algorithm
  x := 7;
  y := 2;
  z := 3;
end A;
