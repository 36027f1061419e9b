model A
  Real r = a /* 1 */ * b; // 2
end A;
