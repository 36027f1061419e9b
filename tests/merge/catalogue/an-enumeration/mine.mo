model A
  type T = enumeration(a, b); // m
end A;
