model A
  B b(x = f(1 /* mine */ /* old */));
end A;
