model A
  B b annotation (choicesAllMatching = true, Dialog(group = "a"));
end A;
