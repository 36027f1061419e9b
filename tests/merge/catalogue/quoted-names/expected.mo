model A
  Real 'a b'(start = 2) "d";
equation
  connect('c;d', 'a b');
  connect('x(', y);
end A;
