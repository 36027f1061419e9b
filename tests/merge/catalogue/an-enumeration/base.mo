model A
  type T = enumeration(a, b);
end A;
