model A
  parameter Real a[:, 2] = {
      {1, 2},
      {1, 2}};
end A;
