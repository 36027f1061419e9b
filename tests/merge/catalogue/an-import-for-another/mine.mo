model A
  import S = M;
end A;
