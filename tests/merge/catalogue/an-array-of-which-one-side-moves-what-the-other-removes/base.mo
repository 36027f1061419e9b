model A
  R r(v = {a, b, c, d, e});
end A;
