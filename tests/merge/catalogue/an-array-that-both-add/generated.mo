model A
  R r(v = {b, c});
end A;
