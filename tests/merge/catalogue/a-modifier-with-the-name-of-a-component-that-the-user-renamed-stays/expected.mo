model A
  B y(m = f(x = y), x(k = 3));
end A;
