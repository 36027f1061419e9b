model A
algorithm
  x := 3;
end A;
