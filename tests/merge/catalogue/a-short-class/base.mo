model A
  type T = Real(min = 0, max = 1) "d";
end A;
