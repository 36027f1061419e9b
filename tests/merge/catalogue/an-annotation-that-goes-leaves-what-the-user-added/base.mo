model A
  B b annotation (Dialog(group = "a"));
end A;
