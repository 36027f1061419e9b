model A
  Real 'a b'(start = 1) "d";
equation
  connect('c;d', 'a b');
end A;
