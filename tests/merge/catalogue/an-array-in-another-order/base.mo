model A
  R r(v = {a.x, b.x, c.x}, w = 1);
end A;
