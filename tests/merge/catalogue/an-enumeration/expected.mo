model A
  type T = enumeration(a, c); // m
end A;
