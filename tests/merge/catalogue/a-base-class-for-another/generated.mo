model A
  extends G;
end A;
