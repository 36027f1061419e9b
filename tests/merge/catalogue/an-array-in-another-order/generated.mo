model A
  R r(v = {b.x, c.x, a.x}, w = 1);
end A;
