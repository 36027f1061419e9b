model A
  Real x;
  Real m;
  Real g;
protected
  Real p;
  Real mp;
  Real gp;
end A;
