model A
  B b(x = f(2));
end A;
