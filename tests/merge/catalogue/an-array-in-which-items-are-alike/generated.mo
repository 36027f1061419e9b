model A
  R r(v = {a.x, a.x, b.x, c.x, d.x});
end A;
