model A
  Real x;
protected
  Real p;
end A;
