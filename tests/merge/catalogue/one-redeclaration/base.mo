model A
  B b(redeclare model X = Y);
end A;
