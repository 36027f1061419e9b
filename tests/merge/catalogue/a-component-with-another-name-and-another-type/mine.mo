model A
  Ball body(m = body.x, n = 1);
equation
  connect(body.frame, c.frame);
end A;
