model A
  B b annotation (choicesAllMatching = true);
end A;
