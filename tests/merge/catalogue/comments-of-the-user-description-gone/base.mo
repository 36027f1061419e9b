model A
  B b
    "d";
end A;
