record A
  extends B(
    centers = {
      {a.x, a.y},
      {b.x, b.y}}, // at the end of a line
  // on its own line
    names = {a.name});
end A;
