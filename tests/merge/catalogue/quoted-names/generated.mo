model A
  Real 'a b'(start = 2);
equation
  connect('a b', 'c;d');
  connect('x(', y);
end A;
