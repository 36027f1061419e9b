model A
  A a;
  C c;
end A;
