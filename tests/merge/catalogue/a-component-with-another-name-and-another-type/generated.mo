model A
  Body b(m = b.x, n = 2);
equation
  connect(b.frame, c.frame);
end A;
