model A
  A a;
  B b;
end A;
