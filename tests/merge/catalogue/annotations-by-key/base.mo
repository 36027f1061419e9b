model A
  annotation (Dialog(group = "a"), __Dymola_x = 1, Evaluate = true);
end A;
