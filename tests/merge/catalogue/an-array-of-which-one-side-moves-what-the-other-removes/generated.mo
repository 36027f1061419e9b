model A
  R r(v = {b, c, d, e});
end A;
