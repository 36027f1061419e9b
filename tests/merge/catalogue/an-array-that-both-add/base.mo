model A
  R r;
end A;
