model A
  B b(x = f(1 /* old */));
end A;
