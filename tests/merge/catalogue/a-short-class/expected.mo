model A
  type T = Length(min = 1, max = 2) "e";
end A;
