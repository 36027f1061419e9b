model A
  R r(v = {c.x, a.x, b.x, mine});
end A;
