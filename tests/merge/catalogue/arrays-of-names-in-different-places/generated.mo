model A
  R r(v = {c.x, a.x, b.x});
end A;
