model A
  R r(v = {a, b});
end A;
