model A
  // 1
end A;
