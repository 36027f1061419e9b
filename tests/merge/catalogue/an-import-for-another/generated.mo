model A
  import S = G;
end A;
