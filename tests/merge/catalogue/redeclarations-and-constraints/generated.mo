model A
  replaceable B b(redeclare model X = Z, redeclare Real z(start = 1)) constrainedby C(k = 3) "d";
end A;
