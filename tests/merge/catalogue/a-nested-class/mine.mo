model A
  model N
    Real x;
    Real m;
  end N;
end A;
