model A
  Real x;
  Real g;
protected
  Real p;
  Real gp;
end A;
