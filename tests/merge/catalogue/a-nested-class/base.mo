model A
  model N
    Real x;
  end N;
end A;
