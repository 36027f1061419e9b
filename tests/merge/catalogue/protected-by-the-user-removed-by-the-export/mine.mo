model A
  Real x;
protected
  Real y;
end A;
