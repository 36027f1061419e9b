model A
  R r(v = {a.x, b.x, c.x}, w = 2);
end A;
