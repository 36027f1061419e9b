model A
  Real r = f(
    1,
    0,
    0,
    7,
    0);
end A;
