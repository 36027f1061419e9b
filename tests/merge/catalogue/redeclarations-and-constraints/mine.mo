model A
  replaceable B b(redeclare model X = Y, redeclare Real z(start = 2)) constrainedby C(k = 1, m = 2);
end A;
