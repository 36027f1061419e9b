model A
equation
  connect(b, a); // mine
end A;
