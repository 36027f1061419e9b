model A
  B y(m = 1);
end A;
