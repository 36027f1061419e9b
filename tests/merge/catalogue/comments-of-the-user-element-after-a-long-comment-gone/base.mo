model A
 B b;
  C c;
end A;
