model A
  parameter Real a[:, 2] = {
      {1, 2},
      {1, 2},
      {3, 4}}
  // m
;
end A;
