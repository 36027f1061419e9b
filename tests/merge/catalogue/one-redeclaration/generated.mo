model A
  B b(redeclare model X = G);
end A;
