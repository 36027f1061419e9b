model A
  B b // 1
    "d";
end A;
