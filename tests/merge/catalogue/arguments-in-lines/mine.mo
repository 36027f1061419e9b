model A
  Real r = f(
    2,
    0,
    0,
    0);
end A;
