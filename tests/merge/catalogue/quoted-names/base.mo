model A
  Real 'a b'(start = 1);
equation
  connect('a b', 'c;d');
end A;
