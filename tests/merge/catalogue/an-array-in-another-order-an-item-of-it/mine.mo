model A
  R r(v = {a.x, 5, c.x});
end A;
