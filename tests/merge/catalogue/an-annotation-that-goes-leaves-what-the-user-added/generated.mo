model A
  B b;
end A;
