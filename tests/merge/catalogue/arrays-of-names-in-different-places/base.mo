model A
  R r(v = {a.x, b.x});
end A;
