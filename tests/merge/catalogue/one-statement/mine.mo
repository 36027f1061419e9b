model A
algorithm
  x := 2;
end A;
