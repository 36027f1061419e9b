model A
  Real x;
  Real m;
protected
  Real p;
  Real mp;
end A;
