model A
  extends M;
end A;
