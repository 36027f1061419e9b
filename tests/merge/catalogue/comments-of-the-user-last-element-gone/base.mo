model A
  A a;

  B b(x = 1);
end A;
