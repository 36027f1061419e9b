model A
  B b = 1;
end A;
