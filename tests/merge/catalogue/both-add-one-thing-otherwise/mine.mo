model A
  Real m;
end A;
