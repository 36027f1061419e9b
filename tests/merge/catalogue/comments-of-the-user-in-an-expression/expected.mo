model A
  Real r = a * c /* 1 */; // 2
end A;
