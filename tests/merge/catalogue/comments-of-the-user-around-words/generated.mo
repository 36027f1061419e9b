model A
  A a(x = 2) "d";
end A;
