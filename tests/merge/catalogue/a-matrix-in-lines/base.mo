model A
  R r(m = [1, 2;
    2, 3;
    3, 4]);
end A;
