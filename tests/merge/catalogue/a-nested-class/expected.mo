model A
  model N
    Real x(start = 1);
    Real m;
    Real g;
  end N;
end A;
