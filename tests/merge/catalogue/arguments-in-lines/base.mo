model A
  Real r = f(
    1,
    0,
    0,
    0);
end A;
