model A
  B b(x = f(2) /* mine */);
end A;
