model A
  Real m =
    b.m +
    c.m;
end A;
