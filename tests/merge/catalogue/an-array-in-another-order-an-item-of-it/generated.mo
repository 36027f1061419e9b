model A
  R r(v = {b.x, c.x, a.x});
end A;
