model A
  B b(x = 1) "m";
end A;
