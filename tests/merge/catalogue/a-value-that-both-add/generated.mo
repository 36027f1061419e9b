model A
  B b = 2;
end A;
