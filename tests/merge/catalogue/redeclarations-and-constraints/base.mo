model A
  replaceable B b(redeclare model X = Y, redeclare Real z(start = 1)) constrainedby C(k = 1);
end A;
