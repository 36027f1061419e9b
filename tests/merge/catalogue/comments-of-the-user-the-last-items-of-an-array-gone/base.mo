record A
  extends B(
    centers = {
      {a.x, a.y},
      {b.x, b.y},
      {c.x, c.y}},
    names = {a.name});
end A;
