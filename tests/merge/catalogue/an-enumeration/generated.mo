model A
  type T = enumeration(a, c);
end A;
