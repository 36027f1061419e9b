model A
  B b "m";
end A;
