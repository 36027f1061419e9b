model A
  Body b(m = b.x, n = 1);
equation
  connect(b.frame, c.frame);
end A;
