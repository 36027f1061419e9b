model A
  C c;
end A;
