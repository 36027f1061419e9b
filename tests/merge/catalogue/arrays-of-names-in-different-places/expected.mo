model A
  R r(v = {c.x, a.x, mine, b.x});
end A;
