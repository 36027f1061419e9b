model A
  Real x annotation (choices(choice = 1, choice = 3), Dialog);
end A;
