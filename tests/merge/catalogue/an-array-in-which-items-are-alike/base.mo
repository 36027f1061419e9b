model A
  R r(v = {a.x, a.x, b.x, c.x});
end A;
