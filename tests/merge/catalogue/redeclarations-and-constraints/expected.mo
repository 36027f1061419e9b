model A
  replaceable B b(redeclare model X = Z, redeclare Real z(start = 2)) constrainedby C(k = 3, m = 2) "d";
end A;
