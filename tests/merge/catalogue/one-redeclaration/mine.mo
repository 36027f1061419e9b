model A
  B b(redeclare model X = M);
end A;
