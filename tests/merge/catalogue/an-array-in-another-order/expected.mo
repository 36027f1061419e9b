model A
  R r(v = {b.x, c.x, a.x}, w = 2);
end A;
