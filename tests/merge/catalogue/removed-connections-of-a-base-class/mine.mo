model A
  extends B(x = 1, break connect(a, b), y = 3);
end A;
