model A
  R r(v = {b, c, d, a, e});
end A;
