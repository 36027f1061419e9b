model A
  R r(v = {a.x, b.x, c.x});
end A;
