model A
  type T = Length(min = 1, max = 1) "e";
end A;
