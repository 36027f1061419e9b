model A
  type T = Real(min = 0, max = 2) "d";
end A;
