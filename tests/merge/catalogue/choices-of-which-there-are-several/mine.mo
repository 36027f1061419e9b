model A
  Real x annotation (choices(choice = 1, choice = 2), Dialog);
end A;
