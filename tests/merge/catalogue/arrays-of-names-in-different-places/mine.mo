model A
  R r(v = {a.x, mine, b.x});
end A;
