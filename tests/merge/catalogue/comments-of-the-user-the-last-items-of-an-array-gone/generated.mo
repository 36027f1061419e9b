record A
  extends B(
    centers = {
      {a.x, a.y},
      {b.x, b.y}},
    names = {a.name});
end A;
