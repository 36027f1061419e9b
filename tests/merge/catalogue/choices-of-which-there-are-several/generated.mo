model A
  Real x annotation (choices(choice = 1, choice = 3));
end A;
