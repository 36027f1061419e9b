model A
  R r(v = {a.x, m, a.x, b.x, c.x});
end A;
