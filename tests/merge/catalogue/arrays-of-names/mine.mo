model A
  R r(v = {a.x, b.x, mine});
end A;
