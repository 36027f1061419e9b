model A
  import S = A;
end A;
