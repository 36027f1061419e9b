model A
  R r(v = {b.x, c.x});
end A;
