model A
  R r(m = [1, 2;
    2, 3;
    3, 5]);
end A;
