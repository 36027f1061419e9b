model A
  B x(m = 1);
end A;
