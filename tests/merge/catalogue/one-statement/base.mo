model A
algorithm
  x := 1;
end A;
