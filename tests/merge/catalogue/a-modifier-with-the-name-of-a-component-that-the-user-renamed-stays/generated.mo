model A
  B x(m = f(x = x), x(k = 3));
end A;
