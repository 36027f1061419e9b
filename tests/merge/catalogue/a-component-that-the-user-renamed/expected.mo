model A
  Body body(m = body.x, n = 2);
equation
  connect(body.frame, c.frame);
end A;
