model A
  extends B(x = 1, break connect(c, d), y = 3);
end A;
