model A
  A a;

  B b(x = 1);
  C c;
end A;
