model A
  Real x;
protected
  Real y = 3;
end A;
